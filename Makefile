# Everything a person does here starts with one of these; `make` alone lists them.

SHELL := /bin/bash
IN_WORKSPACE := source install/setup.bash &&
PYTEST := $(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m pytest --dist=loadfile --no-loadscope-reorder

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help setup demo bench-demo test quick browser reproduction bench-dynamics bench-ik bench-identification bench-curvature bench-discovery \
  bench-inertial bench-link bench-viewer fuzz prototype exams figures notebook equations docs api languages check check-old format lock clean seeded-faults

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-20s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup: ## make .venv, install pinned versions, build the workspace; does nothing where nothing changed
	@PYTHON="$(PYTHON)" sh tools/setup/run.sh

demo: setup ## follow the thesis's helix with real nodes, results in out/demo; VIEW=1 shows it in a browser
	@$(IN_WORKSPACE) python3 -m tools.demo $(if $(VIEW),--view) $(ARGS)

bench-demo: setup ## emulated bench, bridge and simulated arm: pulled, released, recorded, diagnosed; results in out/bench_demo
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m tools.demo.bench $(ARGS)

test: check browser ## run the checks and every test, those with nodes first (ARGS="-k name" are given to pytest)
	@$(PYTEST) --numprocesses=2 -m ros $(ARGS); nodes=$$?; \
	  $(PYTEST) --numprocesses=3 -m "not ros" $(ARGS); rest=$$?; \
	  for code in $$nodes $$rest; do [ $$code -eq 0 ] || [ $$code -eq 5 ] || exit $$code; done

quick: check ## run the checks and the fast unit tests: what to run after every change
	@$(PYTEST) --numprocesses=3 -m "not (ros or hidden_effects or slow)" $(ARGS)

browser: setup ## Chromium and Playwright for the viewer's tests, into out/browser; what cannot be had is left out
	@$(IN_WORKSPACE) test -d out/browser/extra/playwright || \
	  python3 -m pip install --quiet --no-deps --upgrade --target out/browser/extra \
	  --require-hashes -r tools/setup/browser/requirements.txt || echo "Playwright cannot be installed: the browser tests are skipped"
	@$(IN_WORKSPACE) python3 -m tools.setup.browser

seeded-faults: setup ## put small faults into a copy of the code and tell which ones no test finds; ARGS="--only dynamics"
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m tools.benchmarks.seeded_faults $(ARGS)

reproduction: setup ## make the thesis's dynamic results again; overwrites docs/reproduction.md unless ARGS="--out FOLDER"
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m tools.benchmarks.reproduction $(ARGS)

bench-dynamics: setup ## measure the integrators (6 minutes); with docs/numerics.md, unless ARGS="--out FOLDER" or --quick
	@$(IN_WORKSPACE) python3 -m pip install --quiet --no-deps --upgrade --target out/bench_dynamics/extra \
	  --require-hashes -r tools/benchmarks/dynamics/requirements.txt || echo "scikit-sundae cannot be installed and is left out"
	@$(IN_WORKSPACE) PYTHONPATH="continuum/test:$$PYTHONPATH" python3 -m tools.benchmarks.dynamics $(ARGS)

bench-ik: setup ## measure the inverse kinematics (10 minutes)
	@$(IN_WORKSPACE) python3 -m tools.benchmarks.ik $(ARGS)

bench-identification: setup ## compare the fit with the thesis's swarm (3 minutes); with docs/identify.md
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="test:$$PYTHONPATH" python3 -m tools.benchmarks.identification $(ARGS)

bench-curvature: setup ## holds of known truth: how often intervals hold it, and which model is said to be nearer (2 minutes)
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="test:$$PYTHONPATH" python3 -m tools.benchmarks.curvature $(ARGS)

bench-discovery: setup ## hide effects and see what is found; ARGS="--half held-out --minutes 60"
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="test:$$PYTHONPATH" python3 -m tools.benchmarks.discovery $(ARGS)

fuzz: setup ## damaged and made-up bytes through the bench protocol's parsers (6 minutes)
	@$(IN_WORKSPACE) python3 -m pip install --quiet --no-deps --upgrade --target out/fuzz/extra \
	  --require-hashes -r tools/benchmarks/fuzzing/requirements.txt || echo "atheris cannot be installed and is left out"
	@$(IN_WORKSPACE) python3 -m tools.benchmarks.fuzzing $(ARGS)

bench-inertial: setup ## measure joint angles from inertial sensors (3 minutes); with docs/inertial.md
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="continuum/test:$$PYTHONPATH" python3 -m tools.benchmarks.inertial $(ARGS)

bench-link: setup ## measure the bridge at an emulated bench (90 minutes); with docs/bench.md; ARGS="campaign" for a part
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="continuum_hw_imu/test:test:$$PYTHONPATH" \
	  python3 -m tools.benchmarks.link $(ARGS)

bench-viewer: setup ## processor time of the viewer, latency of others beside it (8 minutes); with docs/viewer.md
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="test:$$PYTHONPATH" python3 -m tools.benchmarks.viewer $(ARGS)

prototype: setup ## diagnose the real arm; overwrites docs/prototype.md unless ARGS="--out FOLDER"
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m tools.benchmarks.prototype $(ARGS)

exams: setup ## arms that nobody of this project made (3 minutes); overwrites docs/exams.md unless ARGS="--out FOLDER"
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m tools.benchmarks.exams $(ARGS)

figures: reproduction prototype ## make every picture of docs/pictures again, and with two of them their pages (5 minutes)
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 PYTHONPATH="test:$$PYTHONPATH" python3 -m tools.docs.figures $(ARGS)

notebook: setup ## run examples/find_the_hidden_effect.ipynb and save its outputs in it
	@$(IN_WORKSPACE) OPENBLAS_NUM_THREADS=1 python3 -m tools.docs.notebook examples/find_the_hidden_effect.ipynb

equations: setup ## look up where the thesis's equations, tables and figures are in the code; overwrites docs/equations.md
	@$(IN_WORKSPACE) python3 -m tools.docs.equations $(ARGS)

docs: setup ## the pages as one site with the library's reference, in out/docs/site/index.html
	@$(IN_WORKSPACE) test -d out/docs/extra/mkdocs || \
	  python3 -m pip install --quiet --no-deps --upgrade --target out/docs/extra --require-hashes -r tools/docs/site/requirements.txt
	@$(IN_WORKSPACE) PYTHONPATH="out/docs/extra:$$PYTHONPATH" python3 -m tools.docs.site

api: setup ## the library's reference from its docstrings, in out/api/index.html
	@$(IN_WORKSPACE) python3 -m tools.docs.api $(ARGS)

languages: setup ## collect the sentences to translate into continuum/continuum/languages/*.po, and compile these
	@$(IN_WORKSPACE) python3 -m tools.docs.languages

check: setup ## style, lint and types, without the tests
	@$(IN_WORKSPACE) ruff format --check --quiet && ruff check --quiet && mypy

check-old: setup ## the versions of Ubuntu 24.04 in a second environment below out/: commands, a diagnosis, a node (10 minutes at first)
	@$(IN_WORKSPACE) PYTHON="$(PYTHON)" python3 -m tools.setup.check_old

format: setup ## put the code into the project's style and mend what the linter can
	@$(IN_WORKSPACE) ruff format && ruff check --fix

lock: ## resolve tools/setup/requirements.in into requirements.lock; the same for check-old; hashes of what single tools need
	@PYTHON="$(PYTHON)" sh tools/setup/run.sh lock

clean: ## remove everything made here: .venv, build, install, log, out and caches
	@rm -rf .venv build install log out .pytest_cache .ruff_cache .mypy_cache .hypothesis
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
