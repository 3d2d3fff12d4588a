# Needs make, and Python 3.11 to 3.14 with venv (Debian and Ubuntu: python3-venv). The environment in .venv is built from
# requirements.lock, and again when that changes or the folder is copied or moved. Tests, lint, documentation and formats
# of instruments need more packages, from requirements-dev.lock, which are added when a target needs them.
PYTHON ?= python3
CORES ?= 2
UV ?= uv
BIN := .venv/bin
SETTINGS ?=
$(foreach file,$(SETTINGS),$(if $(wildcard $(file)),,$(error SETTINGS=$(file): there is no such file in $(CURDIR))))
# Modules are compiled when they are first imported: most of them never are.
PIP_INSTALL = $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile
SNAKEMAKE = $(BIN)/snakemake --cores $(CORES) $(if $(SETTINGS),--configfile $(SETTINGS))
# One line of progress; all that is printed is in results/run.log.
WITH_PROGRESS = $(BIN)/python workflow/run_with_progress.py --

# Interpreters for which requirements.lock was installed and tested; others may lack packages.
CHECK_PYTHON = import sys; (3, 11) <= sys.version_info < (3, 15) or sys.exit("Python 3.11 to 3.14 is needed, and \
$(PYTHON) is " + sys.version.split()[0] + "; make PYTHON=... names another one")
# The package immutables has no wheel for Python 3.14 and is compiled there.
CHECK_COMPILER = import shutil, sys; from pathlib import Path; from sysconfig import get_config_var, get_path; \
sys.version_info < (3, 14) or shutil.which(get_config_var("CC").split()[0]) and Path(get_path("include"), "Python.h").exists() \
or sys.exit("Snakemake needs immutables, which has no wheel for Python 3.14: a C compiler and Python.h are needed (Debian and \
Ubuntu: apt install gcc python3-dev), or make PYTHON=python3.13")

# Snakemake does not quote the path of the Python interpreter, so that every job would fail.
ifneq ($(words $(CURDIR)),1)
$(error $(CURDIR): the path has a space, with which no job can start; move the folder to a path without spaces)
endif
SPECIAL := $(shell pwd | LC_ALL=C tr -dc '\042\047\134$$`&;|<>()*?[]')
ifneq ($(SPECIAL),)
$(error $(CURDIR): the path has $(SPECIAL), with which no job can start; move the folder to a path without)
endif

# Snakemake, matplotlib and the compiled code have caches in the home folder; Snakemake needs its cache.
ifneq ($(shell test -n "$$HOME" && test -w "$$HOME" && echo writable),writable)
export XDG_CACHE_HOME ?= $(CURDIR)/.snakemake/cache
endif

# The programs in .venv name the folder in which it was built: in a copied or moved folder they would not start, or run
# the packages of the first one.
MOVED := $(if $(wildcard .venv/lock-installed),$(shell grep -qsF "$$(pwd -P)/.venv/bin/python" .venv/bin/pip || echo moved))

.PHONY: help environment environment-dev environment-slurm reproduce beyond paper report check lint ready-to-test test test-all docs test-slurm bench \
	speed stability fine-grids law law-errors large publish peers lock lock-dev lock-peers lock-slurm clean

help:
	@echo "make reproduce     the default reproduction, with the page results/index.html"
	@echo "make beyond        what goes beyond the paper, with the page results/beyond.html"
	@echo "make paper         a larger run of both, with twice as many surfaces as the paper"
	@echo "make report        results/report.html of the existing results"
	@echo "make speed | stability             larger versions of parts of the run"
	@echo "make fine-grids    exponents on grids of up to 4097 elements across; 40 minutes"
	@echo "make check         format, lint, types and the tests of changed files; half a minute"
	@echo "make test          format, lint, types, documentation and the tests that a change needs"
	@echo "make test-all      the same, and the tests that need longer"
	@echo "make docs          the documentation as a website, in build/docs/index.html"
	@echo "make clean         remove results and caches, keep the environment"
	@echo "Before a release:"
	@echo "make bench | large cost of curves and of large maps"
	@echo "make law | law-errors               calibration of the law of the interface"
	@echo "make test-slurm    the workflow through Slurm"
	@echo "make publish       figures, claims and the table of verdicts from results/ into docs/"
	@echo "make peers | lock  environments of other solvers; renew the lock files"
	@echo "Variables: CORES=$(CORES), PYTHON=$(PYTHON); SETTINGS=mine.yaml for reproduce, report, speed, stability, fine-grids."

environment: .venv/package-installed

.PHONY: moved
moved:

.venv/lock-installed: requirements.lock $(MOVED)
	@$(PYTHON) -c '$(CHECK_PYTHON)'
	@$(PYTHON) -c '$(CHECK_COMPILER)'
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
		{ echo "The Python modules venv and ensurepip are needed; Debian and Ubuntu: apt install python3-venv" >&2; exit 1; }
	$(PYTHON) -m venv $(if $(MOVED),--clear) .venv
	$(PIP_INSTALL) --require-hashes -r requirements.lock
	@touch $@

.venv/package-installed: .venv/lock-installed pyproject.toml
	$(PIP_INSTALL) --no-deps --no-build-isolation -e .
	@touch $@

environment-dev: .venv/dev-installed

.venv/dev-installed: requirements-dev.lock .venv/package-installed
	$(PIP_INSTALL) --require-hashes --no-deps -r requirements-dev.lock
	@touch $@

# What the Slurm executor needs beyond requirements.lock.
environment-slurm: .venv/slurm-installed

.venv/slurm-installed: requirements-slurm.lock .venv/package-installed
	$(PIP_INSTALL) --require-hashes --no-deps -r requirements-slurm.lock
	@touch $@

TARGETS := all
reproduce: environment
	@$(WITH_PROGRESS) $(SNAKEMAKE) -- $(TARGETS)

beyond: environment
	@$(WITH_PROGRESS) $(SNAKEMAKE) -- beyond

paper: override SETTINGS := config/paper.yaml
paper: override TARGETS := all beyond sensitivities
paper: reproduce

# Includes what goes beyond the paper if it was made.
report: environment
	$(SNAKEMAKE) --report results/report.html -- all $(patsubst results/%.html,%,$(wildcard results/beyond.html))

# Written in full each time (-E): pages that are kept would hide the warnings of an earlier run.
docs: environment-dev
	$(BIN)/sphinx-build -q -W -E -b html docs build/docs

# Tests run Python hundreds of times, which would compile every source again.
unexport PYTHONDONTWRITEBYTECODE

# What takes half a minute of `make test`, for the change at hand; COMMIT= compares with another commit than the last.
COMMIT ?= HEAD
check: lint
	@tests=$$($(BIN)/python tests/changed.py $(COMMIT)) && if [ -n "$$tests" ]; then $(BIN)/python -m pytest $$tests; \
		else echo "no file has changed since $(COMMIT) that has tests of its own"; fi

lint: environment-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check .
	$(BIN)/lint-imports
	$(BIN)/mypy

# Takes as long as the documentation, which is made at the same time.
ready-to-test: lint
	$(BIN)/snakemake --lint
	$(BIN)/python -m viscorough_study.run.kernels

test: environment-dev
	@$(MAKE) --no-print-directory --jobs $(CORES) docs ready-to-test
	$(BIN)/python -m pytest -n $(CORES) --dist worksteal -m "not long"

# Also the tests marked `long`, such as interrupted runs of the workflow and many random motions.
test-all: test
	$(BIN)/python -m pytest -n $(CORES) --dist worksteal -m long

bench: environment
	$(BIN)/python benchmarks/curves.py --output results/benchmarks.json

speed stability: SETTINGS = config/methods.yaml
fine-grids: SETTINGS = config/fine_grids.yaml

speed: environment
	$(SNAKEMAKE) -- speed
	$(BIN)/python benchmarks/solver_race.py --output results/tables/other_solvers.csv
	$(BIN)/python benchmarks/second_solver.py --output results/tables/second_solver.csv

stability: environment
	$(SNAKEMAKE) -- stability
	$(BIN)/python benchmarks/campaign.py --cores $(CORES) --output results/campaign.json

fine-grids: environment
	$(SNAKEMAKE) -- fine_grids

law: environment
	PYTHONPATH=benchmarks $(BIN)/python calibration/law.py --cores $(CORES) --output results/tables/law.csv

law-errors: environment
	PYTHONPATH=benchmarks $(BIN)/python calibration/law_errors.py --cores $(CORES) --output results/tables/law_errors.csv

large: environment
	$(BIN)/python benchmarks/large_discs.py --cores $(CORES) --output results/tables/large.csv

publish: environment
	$(BIN)/python benchmarks/publish.py --verdicts regions

test-slurm: environment-slurm
	$(BIN)/python benchmarks/slurm.py --output results/slurm.json

include peers/targets.mk

LOCK = $(UV) pip compile --quiet pyproject.toml --universal --python-version 3.11 --generate-hashes --no-header --no-annotate
# Only packages that are not in requirements.lock, in versions that are compatible with it.
FURTHER = --constraints requirements.lock $$(sed -n 's/^\([^ =]*\)==.*/--no-emit-package \1/p' requirements.lock)

lock:
	$(LOCK) --extra build --extra study --output-file requirements.lock
	$(MAKE) lock-dev lock-slurm

lock-dev:
	$(LOCK) --extra formats --extra test --extra docs $(FURTHER) --output-file requirements-dev.lock

lock-slurm:
	$(LOCK) --extra slurm $(FURTHER) --output-file requirements-slurm.lock

clean:
	find results -mindepth 1 ! -path results/README.md -delete
	rm -rf .snakemake .pytest_cache .ruff_cache .mypy_cache .hypothesis build
	find src tests workflow benchmarks calibration docs -name __pycache__ -prune -exec rm -rf {} + 2>/dev/null || true
