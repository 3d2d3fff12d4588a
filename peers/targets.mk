# Other contact solvers to compare with, in two environments of their own. One that cannot be installed is left out.
PEERS_PIP = -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps
PEERS_EIGEN = $$(.venv-peers/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/cmeel.prefix/share/eigen3/cmake
PEERS_LOCK = $(UV) pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-header --no-annotate

peers: .venv-peers/installed .venv-slippy/installed

# ASPHER is compiled for this processor, as its authors do for themselves. It takes two minutes.
.venv-peers/installed: peers/modern.lock peers/aspher.lock
	$(PYTHON) -m venv --clear .venv-peers
	-.venv-peers/bin/python $(PEERS_PIP) --only-binary :all: -r peers/modern.lock
	-PATH="$(CURDIR)/.venv-peers/bin:$$PATH" CMAKE_ARGS="-DEigen3_DIR=$(PEERS_EIGEN) -DASPHER_NATIVE=ON" \
		.venv-peers/bin/python $(PEERS_PIP) --no-build-isolation --no-cache-dir -r peers/aspher.lock
	@touch $@

.venv-slippy/installed: peers/slippy.lock
	$(PYTHON) -m venv --clear .venv-slippy
	-.venv-slippy/bin/python $(PEERS_PIP) --only-binary :all: -r peers/slippy.lock
	@touch $@

lock-peers:
	$(PEERS_LOCK) peers/modern.in --output-file peers/modern.lock
	$(PEERS_LOCK) --no-deps peers/aspher.in --output-file peers/aspher.lock
	$(PEERS_LOCK) --override peers/slippy.override peers/slippy.in --output-file peers/slippy.lock
