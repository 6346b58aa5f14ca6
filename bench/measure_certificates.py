#!/usr/bin/env python3
"""How near certificates come to the best view, after how long.

    PYTHONPATH=build/release/python bench/measure_certificates.py STUDY [--limit-s S ...] [--every N]
        [--gain expected]

STUDY is the folder of a study that was run, or begun: its maps, starts and motion times are the
questions, of which every N-th is asked, on one core. Prints a table with a row a time limit.
"""
import argparse
import json
import os
import pathlib

import nbvopt

GAP = 0.01  # enough is enough
SHARES = (0.01, 0.02, 0.05, 0.10)


def questions(study, every):
    """Map file, base, joints and motion time of every N-th question."""
    asked = [
        (folder_map["file"], start["base"], start["joints"], time_s)
        for folder_map in study["maps"]
        for start in folder_map["starts"]
        for time_s in study["motion_times_s"]
    ]
    return asked[::every]


def ask(asked, robot, limit_s):
    """The certified answer to each question, and by how much it is better than the plain one."""
    gaps, rises = [], []
    planner, of_file = None, None
    for file, base, joints, time_s in asked:
        if file != of_file:
            planner, of_file = nbvopt.Planner(nbvopt.Map(file), robot), file
        plain = planner.plan(base, joints, time_s)
        if plain.status == "no_gain_in_reach":
            continue
        certified = planner.plan(base, joints, time_s, certify=GAP, time_limit_ms=1000 * limit_s)
        gaps.append(certified.gap)
        rises.append(certified.gain / plain.gain - 1)
    return sorted(gaps), rises


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("--limit-s", type=float, nargs="+", default=[0.1, 1.0])
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--gain", default=None)
    arguments = parser.parse_args()

    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    study = json.loads((arguments.study / "study.json").read_text())
    robot = nbvopt.Robot()
    if arguments.gain:
        robot = nbvopt.Robot.parse(f"sensor: {{gain: {arguments.gain}}}\n")
    asked = questions(study, arguments.every)

    print("| after | questions | median gap |" + "".join(f" within {s:.0%} |" for s in SHARES)
          + " worst | bettered | at most by |")
    print("| ---: " * (6 + len(SHARES)) + "|")
    for limit_s in arguments.limit_s:
        gaps, rises = ask(asked, robot, limit_s)
        shares = "".join(f" {sum(g <= s for g in gaps) / len(gaps):.0%} |" for s in SHARES)
        print(f"| {limit_s:g} s | {len(gaps)} | {gaps[len(gaps) // 2]:.1%} |{shares} {gaps[-1]:.0%} |"
              f" {sum(r > 0 for r in rises)} | {max(rises):.1%} |", flush=True)


if __name__ == "__main__":
    main()
