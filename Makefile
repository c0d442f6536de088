# Three commands on a fresh machine with Python 3.11 or newer:
#   make setup  sets up .venv
#   make run    sets up .venv and runs the whole pipeline
#   make test   sets up .venv and runs the tests
PYTHON ?= python3
JOBS ?= 2
VENV := .venv
BIN := $(VENV)/bin
export PATH := $(CURDIR)/$(BIN):$(PATH)

.PHONY: setup run joint test test-kernel lint format report docs docs-links clean

setup: $(VENV)/ready
	@echo "ready; now: . $(BIN)/activate"

run: $(VENV)/ready
	snakemake -j$(JOBS)

# the five factors of plates and rubbers together, on top of the default study
joint: $(VENV)/ready
	snakemake -j$(JOBS) --configfile config/joint.yaml

report: $(VENV)/ready
	snakemake -j$(JOBS) report

test: $(VENV)/ready-dev
	python -m pytest -n $(JOBS) --dist loadfile

# the numerical tests once more with the plainest kernels of OpenBLAS and NumPy, two threads and another
# seed: a test that depends on the last bits of one processor fails here (browsers do not use these kernels)
ifeq ($(shell uname -m),x86_64)
PLAIN := OPENBLAS_CORETYPE=Prescott NPY_DISABLE_CPU_FEATURES="X86_V3 X86_V4 AVX512_ICL AVX512_SPR"
else
PLAIN := OPENBLAS_CORETYPE=ARMV8
endif

test-kernel: $(VENV)/ready-dev
	$(PLAIN) OPENBLAS_NUM_THREADS=2 python -m pytest -q -n $(JOBS) --hypothesis-seed=2 \
	  -k "not browser and not accessibility and not save_figures" \
	  $(addprefix tests/unit/,calibrate lca reduce report surface fe/elements fe/matrices)

# the documentation site, build/site/index.html: every warning is an error, every link is followed
SPHINX := python -m sphinx -n -W --keep-going -q -c docs
docs: $(VENV)/ready-docs
	$(SPHINX) -b html . build/site
	python docs/check_site.py build/site

# the links that lead to other sites: this needs a network, so CI does not run it
docs-links: $(VENV)/ready-docs
	$(SPHINX) -b linkcheck . build/links

lint: $(VENV)/ready-dev
	ruff check .
	ruff format --check .
	snakefmt --check Snakefile workflow/Snakefile workflow/rules
	mypy
	lint-imports

format: $(VENV)/ready-dev
	ruff check --fix .
	ruff format .
	snakefmt Snakefile workflow/Snakefile workflow/rules

$(VENV)/ready: pyproject.toml constraints.txt
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "nptcs needs Python 3.11 or newer")'
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e .
	touch $@

$(VENV)/ready-dev: $(VENV)/ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	touch $@

$(VENV)/ready-docs: $(VENV)/ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[docs]'
	touch $@

clean:
	rm -rf $(VENV) build .snakemake results/[0-9]* results/tables results/logs results/report* results/workbook* results/verdict* results/material_card.json
