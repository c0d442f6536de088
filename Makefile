# Two commands do everything on a fresh machine with Python 3.11 or newer:
#   make run    sets up .venv and runs the whole pipeline
#   make test   sets up .venv and passes the tests
PYTHON ?= python3
JOBS ?= 2
VENV := .venv
BIN := $(VENV)/bin
export PATH := $(CURDIR)/$(BIN):$(PATH)

.PHONY: run test lint format report clean

run: $(VENV)/ready
	snakemake -j$(JOBS)

report: $(VENV)/ready
	snakemake -j$(JOBS) report

test: $(VENV)/ready-dev
	python -m pytest -n $(JOBS)

lint: $(VENV)/ready-dev
	ruff check .
	ruff format --check .
	snakefmt --check Snakefile workflow/rules
	mypy
	lint-imports

format: $(VENV)/ready-dev
	ruff check --fix .
	ruff format .
	snakefmt Snakefile workflow/rules

$(VENV)/ready: pyproject.toml constraints.txt
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "nptcs needs Python 3.11 or newer")'
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e .
	touch $@

$(VENV)/ready-dev: $(VENV)/ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	touch $@

clean:
	rm -rf $(VENV) .snakemake results/[0-9]* results/tables results/logs results/report* results/workbook* results/verdict* results/material_card.json
