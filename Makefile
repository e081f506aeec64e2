# Each target sets up .venv on first use (see .ci/venv). PYTHON=python3.12 chooses the interpreter.
SHELL := /bin/bash
.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help demo test test-full bench soak lint format docs site coverage wheel clean setup-demo setup-test setup-bench setup-dev setup-docs

BIN := .venv/bin
# Nothing leaves this host unless the user opens it: ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET make demo
export ROS_AUTOMATIC_DISCOVERY_RANGE ?= LOCALHOST
# Compiled modules are kept: else each process, and the tests start many, would compile them again.
unexport PYTHONDONTWRITEBYTECODE
# The tests run three at a time, since many wait for other processes; more threads inside numpy
# would only get in each other's way.
PYTEST := OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -q --numprocesses 3 \
	--dist loadfile --no-loadscope-reorder

help:
	@echo 'make demo       quadrotor in a gust: simulator and controller over ROS 2; writes out/demo/'
	@echo 'make test       the tests; ARGS="-k rov" chooses some'
	@echo 'make test-full  the tests with their large volumes, then the benchmarks into benchmarks/results/'
	@echo 'make bench      the benchmarks, short runs into out/bench/ (FULL=1: as in test-full)'
	@echo 'make soak       30 min at full speed with everything on: what grows (WALL=5: for 5 min)'
	@echo 'make lint       ruff, mypy, clang-format (make format: let them rewrite the files)'
	@echo 'make docs       write the tables of the documentation; check its links and pictures'
	@echo 'make site       the documentation as pages of HTML: out/site/index.html'
	@echo 'make coverage   the lines that the tests run through, Python and C++; out/coverage/'
	@echo 'make wheel      dist/: a wheel that needs no compiler, and the source archive'
	@echo 'make clean      remove what was built (.venv stays; rm -r .venv removes that)'

setup-demo setup-test setup-bench setup-dev setup-docs: setup-%:
	@.ci/venv $*

demo: setup-demo
	@$(BIN)/fluid_sim demo

test: setup-test
	@$(PYTEST) $(ARGS)

test-full: setup-bench
	@FLUID_SIM_FULL=1 $(PYTEST) -m 'full or not full'
	@.ci/bench full

bench: setup-bench
	@.ci/bench $(if $(FULL),full,quick)

soak: setup-bench
	@$(BIN)/python -m benchmarks.robustness.soak $(if $(WALL),--wall $(WALL)) --json out/soak.json

lint: setup-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python .ci/check_repository.py
	$(BIN)/clang-format --dry-run -Werror $(shell find fluid_sim_ros/plugins/src -name "*.cc" -o -name "*.h")

format: setup-dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(shell find fluid_sim_ros/plugins/src -name "*.cc" -o -name "*.h")

docs: setup-demo
	@PYTHONPATH=. $(BIN)/python .ci/doc_tables.py
	@PYTHONPATH=. $(BIN)/python .ci/foxglove_layouts.py
	@$(BIN)/python .ci/check_docs.py

site: setup-docs
	@PYTHONPATH=. $(BIN)/python .ci/site_pages.py

coverage:
	@.ci/coverage

wheel:
	@.ci/wheel

clean:
	rm -rf build install log dist out *.egg-info .pytest_cache .hypothesis .mypy_cache .ruff_cache
	rm -f fluid_sim_ros/plugins/libfluid_sim.so MUJOCO_LOG.TXT
	find . -path ./.venv -prune -o -name __pycache__ -type d -prune -exec rm -rf {} +
