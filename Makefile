# Everything runs in .venv, which is made on first use from requirements.txt.
PYTHON ?= python3
WORKERS ?= 2
NODES ?= 10000 100000
SIZES ?= 100 400

VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
LOWEST := .venv-lowest
LOCK := .venv-lock
# Installs the same as pip in a tenth of the time, and finds the oldest versions that are allowed.
UV := uv==0.13.9
# Tests that run with the oldest versions: one file for each part of the library.
OLDEST := backends.py criteria.py delaunay.py interpolant.py mesh.py optimal.py records.py refinement.py \
    smoothing.py swapping.py

# The debugger inside Jupyter kernels warns about frozen modules; nobody debugs here.
export PYDEVD_DISABLE_FILE_VALIDATION := 1

.DEFAULT_GOAL := help
.PHONY: help book lint test test-lowest notebooks bench lock clean

help: ## Show this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14

# --all: changes in meshlib/ do not touch the pages, so every page is read and run again.
book: $(READY) ## Run the notebooks and build _build/html/index.html
	$(BIN)/jupyter-book build . --all -W -n --keep-going

lint: $(READY) ## Style, layout, spelling, types; the explorer's scripts where there is npm
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/codespell
	$(BIN)/mypy
	@if command -v npm >/dev/null; then npm ci --no-audit --no-fund --loglevel=error && npm run --silent lint; \
	    else echo "No npm: the scripts of the explorer were not checked."; fi

# First what plain Python alone can break: test_backends compares both backends by itself,
# test_plain asks for no backend, test_properties takes long, a browser runs no Python. This run
# measures coverage, since it sees kernels and runs no notebooks, whose kernels would warn that
# they measured nothing. Then everything, with a list of what was skipped; loadfile keeps a
# notebook on one kernel.
test: $(READY) ## Unit tests (both backends), coverage, doctests, the built book, notebooks against their stored output
	MESHLIB_BACKEND=python $(BIN)/python -m pytest tests -q -n $(WORKERS) --dist loadfile \
	    --ignore tests/test_backends.py --ignore tests/test_plain.py --ignore tests/test_properties.py \
	    --ignore tests/browser --cov --cov-report=term
	$(BIN)/python -m pytest tests meshlib notebooks --doctest-modules -rs \
	    --nbval --nbval-current-env -n $(WORKERS) --dist loadfile

# The core, and the extras that the library itself imports, in the oldest versions; the tools that
# test are new. What needs the book, a browser or a cluster is left out.
test-lowest: ## Unit tests with the oldest versions that pyproject.toml promises
	$(PYTHON) -m venv $(LOWEST)
	$(LOWEST)/bin/python -m pip install --quiet --disable-pip-version-check $(UV)
	$(LOWEST)/bin/uv pip install --quiet --python $(LOWEST)/bin/python --resolution lowest-direct \
	    -e '.[fast,plot,widgets,io,studies]'
	$(LOWEST)/bin/uv pip install --quiet --python $(LOWEST)/bin/python pytest pytest-xdist hypothesis shewchuk
	$(LOWEST)/bin/python -m pytest -q -n $(WORKERS) --dist loadfile -W default $(addprefix tests/test_, $(OLDEST))

notebooks: $(READY) ## Run the notebooks in place and strip what changes from run to run
	$(BIN)/python book/execute.py notebooks/*.ipynb

bench: $(READY) ## Time, memory and errors against peers, an hour for a million nodes: make bench NODES=1000000
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r benchmarks/requirements.txt
	$(BIN)/python benchmarks/run.py --nodes $(NODES) --sizes $(SIZES) $(if $(JSON),--json $(JSON))

lock: ## Pin the newest versions that pyproject.toml allows in requirements.txt
	$(PYTHON) -m venv $(LOCK)
	$(LOCK)/bin/python -m pip install --quiet --disable-pip-version-check $(UV)
	$(LOCK)/bin/uv pip compile pyproject.toml --all-extras --upgrade --quiet --fork-strategy fewest \
	    --universal --python-version 3.11 --no-annotate --no-header -o requirements.txt
	echo '-e .' >> requirements.txt

clean: ## Remove everything that is not in the repository, the environment too
	rm -rf $(VENV) $(LOWEST) $(LOCK) _build build *.egg-info node_modules .coverage
	rm -rf .pytest_cache .hypothesis .ruff_cache .mypy_cache
	find . -name __pycache__ -prune -exec rm -rf {} +

$(READY): requirements.txt pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed: make PYTHON=python3.12 ..." if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check $(UV)
	$(BIN)/uv pip install --quiet --python $(BIN)/python -r requirements.txt
	touch $@
