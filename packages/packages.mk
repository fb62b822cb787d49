# Included by the Makefile: the library as packages, installed and taken away.

PREFIX ?= /usr/local
VERSION := $(shell sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
LIBRARY_CFLAGS ?= -O2
ifeq ($(shell uname -s),Darwin)
SHARED = build/libneuralsvcd.dylib
SONAME = -install_name $(PREFIX)/lib/libneuralsvcd.dylib
else
SHARED = build/libneuralsvcd.so
SONAME = -Wl,-soname,libneuralsvcd.so.$(VERSION)
endif

build/library.o: packages/neuralsvcd.c $(LIBRARY) | build
	$(CC) $(LIBRARY_CFLAGS) -std=c99 -fPIC -I. -c -o $@ $<
$(SHARED): build/library.o
	$(CC) -shared $(SONAME) -o $@ $< -lm
build/libneuralsvcd.a: build/library.o
	$(AR) rcs $@ $<
# For any machine, as the library is. A program called `verify` would be too much in a folder of all programs.
build/installed/svcd: examples/svcd.c $(SCENERY) $(LIBRARY)
build/installed/svcd-verify: examples/verify/verify.c $(VERIFIER)
PROGRAMS = build/installed/svcd build/installed/svcd-verify
$(PROGRAMS):
	@mkdir -p $(@D)
	$(CC) $(LIBRARY_CFLAGS) -std=c99 -o $@ $< -lm
shared: $(SHARED)  ## a shared library, build/libneuralsvcd.so
static: build/libneuralsvcd.a  ## a static one
# The name must stay: the header takes itself in.
release: build/release/neuralsvcd.h  ## one file that holds neuralsvcd.h and weights.h
build/release/neuralsvcd.h: $(LIBRARY)
	@mkdir -p $(@D)
	sed -e '/^#include "weights.h"$$/{r weights.h' -e 'd;}' neuralsvcd.h >$@

# DESTDIR=folder is put before PREFIX.
# The checker of certificates needs nothing of the library; what documents it all goes with it.
INSTALLED_HEADERS = neuralsvcd.h weights.h $(wildcard examples/verify/nsvcd_verify*.h)
DOCUMENTS = LICENSE examples/FORMATS.md
# What svcd says of itself, and where that is looked for.
MANUALS = man:man/man1/svcd.1 bash:bash-completion/completions/svcd zsh:zsh/site-functions/_svcd fish:fish/vendor_completions.d/svcd.fish
install: shared static $(PROGRAMS)  ## PREFIX=/usr/local: the headers, libraries, svcd, svcd-verify and their manual, pkg-config, a CMake package
	mkdir -p $(DESTDIR)$(PREFIX)/include/neuralsvcd/extras $(DESTDIR)$(PREFIX)/lib/pkgconfig \
	  $(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd $(DESTDIR)$(PREFIX)/share/doc/neuralsvcd
	cp $(INSTALLED_HEADERS) $(DESTDIR)$(PREFIX)/include/neuralsvcd/
	cp $(EXTRAS) $(DESTDIR)$(PREFIX)/include/neuralsvcd/extras/
	cp $(DOCUMENTS) $(DESTDIR)$(PREFIX)/share/doc/neuralsvcd/
	cp build/libneuralsvcd.a $(DESTDIR)$(PREFIX)/lib/
	if test -f build/libneuralsvcd.dylib; then cp build/libneuralsvcd.dylib $(DESTDIR)$(PREFIX)/lib/; else \
	  cp $(SHARED) $(DESTDIR)$(PREFIX)/lib/libneuralsvcd.so.$(VERSION); \
	  ln -sf libneuralsvcd.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/libneuralsvcd.so; fi
	for name in neuralsvcd neuralsvcd-library; do \
	  sed 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|lib|; s|@VERSION@|$(VERSION)|' packages/installed/$$name.pc.in \
	    >$(DESTDIR)$(PREFIX)/lib/pkgconfig/$$name.pc; done
	cp packages/installed/neuralsvcdConfig.cmake $(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd/
	sed 's|@VERSION@|$(VERSION)|' packages/installed/neuralsvcdConfigVersion.cmake.in \
	  >$(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd/neuralsvcdConfigVersion.cmake
	mkdir -p $(DESTDIR)$(PREFIX)/bin && cp $(PROGRAMS) $(DESTDIR)$(PREFIX)/bin/
	for manual in $(MANUALS); do file=$(DESTDIR)$(PREFIX)/share/$${manual#*:}; \
	  mkdir -p $$(dirname $$file) && build/installed/svcd --manual $${manual%%:*} >$$file || exit 1; done
	echo '.so man1/svcd.1' >$(DESTDIR)$(PREFIX)/share/man/man1/svcd-verify.1
uninstall:  ## takes it away again
	rm -rf $(DESTDIR)$(PREFIX)/include/neuralsvcd $(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd \
	  $(DESTDIR)$(PREFIX)/share/doc/neuralsvcd $(DESTDIR)$(PREFIX)/share/man/man1/svcd-verify.1 \
	  $(DESTDIR)$(PREFIX)/lib/libneuralsvcd.* $(DESTDIR)$(PREFIX)/lib/pkgconfig/neuralsvcd.pc \
	  $(DESTDIR)$(PREFIX)/lib/pkgconfig/neuralsvcd-library.pc $(PROGRAMS:build/installed/%=$(DESTDIR)$(PREFIX)/bin/%)
	for manual in $(MANUALS); do rm -f $(DESTDIR)$(PREFIX)/share/$${manual#*:}; done

# Is a joint trajectory free? For controllers: the adapter, what stands in for a controller, its test.
GUARD = packages/trajectory/trajectory_guard.c
build/controller: packages/trajectory/controller.c $(GUARD) packages/trajectory/trajectory_guard.h $(SCENERY) $(LIBRARY) $(EXTRAS) | build
	$(CC) -O2 -std=c99 -Wall -Wextra -DCOUNT_ALLOCATIONS -o $@ $< $(GUARD) -Wl,--wrap=malloc -lm
build/test_guard: packages/trajectory/test_guard.cpp $(GUARD) $(wildcard packages/trajectory/*.h*) $(SCENERY) $(LIBRARY) $(EXTRAS) | build
	$(CC) -O0 -DNSVCD_NO_DISPATCH -g -fsanitize=address,undefined -std=c99 -c -o build/trajectory_guard.o $(GUARD)
	$(CXX) -std=c++11 -Wall -Wextra -Werror -g -fsanitize=address,undefined -o $@ $< build/trajectory_guard.o -lm
.PHONY: check-trajectory
check-trajectory: build/test_guard build/controller build/svcd  # trajectories for controllers
	build/test_guard build
	python3 examples/robot/urdf.py examples/robot/arm.urdf --srdf examples/robot/arm.srdf --scene shelf examples/robot/shelf.urdf build/cell.txt
	echo 'obstacle person capsule: 0.15 0.8  5 5 5 0 0 0 1' >>build/cell.txt
	cat examples/robot/plans.txt >>build/cell.txt
	build/svcd plan build/cell.txt --only up --samples 200 --joints build/up.tsv
	build/controller build/cell.txt shelf person 1.68 build/up.tsv >build/controller.txt; cat build/controller.txt
	grep -q 'stops: .*, person$$' build/controller.txt && grep -q '^there after .* 0 cycles beyond' build/controller.txt
	grep -q ' 0 allocations$$' build/controller.txt

# What is published at npm: a folder that needs no other, and its archive.
NPM_FILES = $(addprefix packages/npm/,package.json README.md neuralsvcd.js neuralsvcd.d.ts)
npm: build/release/neuralsvcd-$(VERSION).tgz  ## build/release/neuralsvcd-X.Y.Z.tgz, for node and browsers
build/npm/glue.wasm: packages/npm/glue.c $(LIBRARY) $(SCENERY)
	@$(MAKE) --no-print-directory -C examples/web ../../$@
build/npm/package/wasm.js: build/npm/glue.wasm packages/packages.mk
	@mkdir -p $(@D)
	{ echo "// Built of neuralsvcd.h $(VERSION): the module, gzip in base64; the names of nsvcd_result."; \
	  echo "export const wasm = '$$(gzip -9nc $< | base64 | tr -d '\n')';"; \
	  echo "export const codes = '$$(sed -n '/^typedef enum nsvcd_result/,/^}/s/^  NSVCD_\(ERROR_\)*\([A-Z_]*\).*/\2/p' neuralsvcd.h | paste -sd' ')'.split(' ');"; } >$@
build/release/neuralsvcd-$(VERSION).tgz: build/npm/package/wasm.js $(NPM_FILES) LICENSE
	@mkdir -p $(@D)
	cp $(NPM_FILES) LICENSE build/npm/package/
	cd build/npm/package && npm pack --silent --pack-destination ../../release

# What is published at crates.io: the crate with the headers, and its archive, which cargo builds once to see that it does.
CRATE_FILES = $(addprefix packages/rust/,Cargo.toml README.md build.rs src tests) neuralsvcd.h weights.h LICENSE
crate: build/release/neuralsvcd-$(VERSION).crate  ## build/release/neuralsvcd-X.Y.Z.crate, for Rust
build/release/neuralsvcd-$(VERSION).crate: $(CRATE_FILES) $(wildcard packages/rust/*/*)
	rm -rf build/crate
	mkdir -p build/crate $(@D)
	cp -r $(CRATE_FILES) build/crate/
	cd build/crate && cargo package --quiet --offline --allow-dirty --target-dir ../crate_built
	cp build/crate_built/package/$(@F) $@
