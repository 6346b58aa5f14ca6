# The commands that people and CI share: a thin layer over the CMake presets.
# PRESET chooses another build, as in `make test PRESET=dev`.
PRESET ?= release
BUILD := build/$(PRESET)
NBVOPT := $(BUILD)/cli/nbvopt
DEMO_EPISODE := --start 0.62,0.71,0 --duration-max 40 --mode auto --motion-time 0.5
DEMO_QUERY := --base 1.9,2.6,1.57 --pan 0 --tilt 0 --height 0.4 --motion-time 1
# What the first build for the demo leaves out; `make build` adds it.
DEMO_WITHOUT := $(patsubst %,-DNBVOPT_BUILD_%=OFF,SERVER STUDY PYTHON TESTS BENCHMARKS)
# One of them needs what `make bench-search` wrote.
NOTEBOOKS ?= 01_one_query 02_solver_study 03_surrogate $(if $(wildcard out/search_quality.jsonl),search_quality)
SOURCES = $(shell find include src solvers cli datasets tests bench examples -name '*.hpp' -o -name '*.cpp')

.PHONY: help packages packages-ros packages-ci packages-notebooks packages-docs build demo demo-ros test \
        bench bench-search bench-server notebook deb docs sanitize sanitize-threads fuzz format check-format tidy tidy-changed clean

help:  ## list the commands
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' Makefile | expand -t 22

packages:
	@cmake/install_packages.sh packages-planner.txt packages.txt

packages-ros:
	@cmake/install_packages.sh packages-planner.txt packages.txt packages-ros.txt

packages-ci:
	@cmake/install_packages.sh packages-planner.txt packages.txt packages-ros.txt packages-ci.txt

packages-notebooks:
	@cmake/install_packages.sh packages-notebooks.txt

packages-docs:
	@cmake/install_packages.sh packages-docs.txt

build: packages  ## configure and build everything
	@cmake --preset $(PRESET) --log-level=WARNING
	@cmake --build --preset $(PRESET)

demo: packages  ## find a next best view, then map a small office in simulation; all lands in out/
	@test -e $(BUILD)/build.ninja || cmake --preset $(PRESET) --log-level=WARNING $(DEMO_WITHOUT)
	@cmake --build --preset $(PRESET) --target nbvopt_cli
	@mkdir -p out
	@$(NBVOPT) query datasets/office_partial.ot $(DEMO_QUERY) --json-out out/answer.json --plot out/view.png
	@echo "The answer is in out/answer.json, the picture in out/view.png"
	@$(NBVOPT) simulate datasets/office.world $(DEMO_EPISODE) --map-out out/office.ot --metrics out/office.jsonl --plot out/episode.png
	@echo "The map is in out/office.ot, its growth in out/office.jsonl, the picture in out/episode.png"

demo-ros: packages-ros  ## the ROS node moves the camera of a simulated robot through the office, for a minute
	@cmake --preset $(PRESET) --log-level=WARNING
	@cmake --build --preset $(PRESET) --target nbvopt_cli nbvopt_ros_nbvopt_node nbvopt_ros_nbvopt_simulated_robot
	@mkdir -p out
	@examples/demo_ros.sh $(BUILD) out $(or $(SECONDS),60) $(DEMO_ROS_ARGS)

test: build  ## run all tests
	@ctest --preset $(PRESET) --output-junit junit.xml

bench: build  ## measure; compare two runs with Google Benchmark's tools/compare.py
	@$(BUILD)/bench/nbvopt_bench $(BENCH_ARGS)

bench-search: build  ## compare searches; every query's answer lands in out/search_quality.jsonl
	@mkdir -p out
	@$(BUILD)/bench/nbvopt_bench_search --json out/search_quality.jsonl $(BENCH_ARGS)

bench-server: build  ## measure the planning server: latency, then ten minutes of scans and plans
	@$(BUILD)/bench/nbvopt_bench_server $(BENCH_ARGS)

notebook: packages packages-notebooks  ## run the notebooks, which draw docs/images; search_quality after bench-search only
	@cmake --preset $(PRESET) --log-level=WARNING
	@cmake --build --preset $(PRESET) --target nbvopt_cli nbvopt_bindings
	@for name in $(NOTEBOOKS); do echo "$$name"; notebooks/run.sh $$name $(BUILD) out/notebooks || exit; done
	@find out/notebooks -maxdepth 1 -name '*.png' -exec cp {} docs/images \;
	@test -f out/search_quality.jsonl || echo "search_quality is left out: run make bench-search first"

deb: packages  ## build Debian packages in build/deb/packages; packaging/try_packages.sh tries them
	@cmake --preset deb --log-level=WARNING
	@cmake --build --preset deb
	@cpack --config build/deb/CPackConfig.cmake -B build/deb/packages

docs: packages-docs  ## make a site of the documentation and the headers in build/docs/site; warnings are errors
	@docs/site/build.sh

sanitize:  ## run the tests under the address and undefined-behaviour sanitizers
	@$(MAKE) --no-print-directory test PRESET=sanitize

sanitize-threads:  ## run the server's tests under the thread sanitizer
	@$(MAKE) --no-print-directory test PRESET=thread

fuzz: packages packages-ci  ## fuzz the readers and the server, 20 seconds each
	@cmake --preset fuzz --log-level=WARNING
	@cmake --build --preset fuzz
	@ctest --preset fuzz --output-junit junit.xml

format: packages-ci  ## format all sources
	@clang-format -i $(SOURCES)

check-format: packages-ci
	@clang-format --dry-run -Werror $(SOURCES)

# Linting needs the generated headers, and nothing else that a build makes.
tidy: packages packages-ci  ## lint all sources; FILES="..." takes some
	@cmake --preset tidy --log-level=WARNING
	@ninja -C build/tidy --quiet src/protocol/generated/nbvopt/v1/planner.pb.h nbvopt_ros_interfaces_made
	@run-clang-tidy -quiet -j 2 -p build/tidy $(or $(addprefix $(CURDIR)/,$(FILES)),'^$(CURDIR)/(src|solvers|cli|datasets|bench)/')

tidy-changed:  ## lint what the newest commits changed
	@files=$$(cmake/changed_sources.sh) && if [ -n "$$files" ]; then \
	  $(MAKE) --no-print-directory tidy FILES="$$files"; else echo "no source was changed"; fi

clean:  ## remove all builds and what the demo wrote
	@rm -rf build out
