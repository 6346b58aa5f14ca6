#!/usr/bin/env python3
"""A worker of studies that only sleeps: what is left of a run is what its coordinator costs.

    nbvopt study run SPEC --out DIR --worker-command "bench/sleeping_worker.py MS"
"""
import json
import sys
import time

print('{"protocol":1}', flush=True)
sleep_s = float(sys.argv[1]) / 1e3
for line in sys.stdin:
    if sleep_s:
        time.sleep(sleep_s)
    unit = json.loads(line)["unit"]
    print(f'{{"unit":"{unit}","answer":{{"slept":true}},"busy_ms":{1e3 * sleep_s}}}', flush=True)
