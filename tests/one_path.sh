#!/bin/sh
# With NSVCD_ONE_PATH, are the bits the same? tests/bench/one_path.c by several compilers, for several instruction sets, and,
# where their tools are there, for aarch64 under QEMU and for WebAssembly under node: one_path.sh, from the
# repository's root. `one_path.sh time` prints what each kind of question takes without the switch and with it, and the
# ratio, the least of ROUNDS runs in turn. Ends with 1 if anything differs.
set -u
CC=${CC:-cc}
out=build/one_path
program=tests/bench/one_path.c
meshes="examples/assets/mug.obj examples/assets/dish_rack.obj $(ls tests/data/meshes/*.obj | head -8)"
mkdir -p $out

if test "${1:-}" = time; then
  $CC -O2 -std=c99 -I. -o $out/free $program -lm || exit 1
  $CC -O2 -std=c99 -I. -DNSVCD_ONE_PATH -o $out/bound $program -lm || exit 1
  for round in $(seq "${ROUNDS:-9}"); do
    $out/free --time $meshes | sed 's/^/free /'
    $out/bound --time $meshes | sed 's/^/bound /'
  done | awk '{ key = $1 " " $2; if (!(key in least) || $3 < least[key]) least[key] = $3 }
    END { for (key in least) { split(key, part, " "); if (part[1] == "free") {
      with = least["bound " part[2]]
      printf "%-9s %7.2f us, with NSVCD_ONE_PATH %7.2f: %.2f\n", part[2], least[key], with, with / least[key] } } }' | sort
  exit
fi

failed=0
builds=0
same() {  # name, how it is run, program
  $2 "$3" $meshes >"$out/$1.txt" 2>&1 || { echo "one-path: $1: $(tail -1 "$out/$1.txt")"; failed=1; return; }
  test $builds = 0 && cp "$out/$1.txt" $out/expected.txt
  builds=$((builds + 1))
  cmp -s "$out/$1.txt" $out/expected.txt && return
  echo "one-path: $1 differs"
  diff $out/expected.txt "$out/$1.txt"
  failed=1
}
build() {  # name, how it is run, compiler and flags; libraries and what is to be linked last
  name=$1 run=$2
  shift 2
  "$@" -Wall -Wextra -Werror -I. -DNSVCD_ONE_PATH -o "$out/$name" $program -lm && same "$name" "$run" "$out/$name" && return
  failed=1
}
build dispatch '' "$CC" -O2 -std=c99
build plain '' "$CC" -O1 -std=c99 -DNSVCD_NO_SIMD
case $(uname -m) in
  x86_64)
    build sse2 '' "$CC" -Os -std=c99 -DNSVCD_NO_DISPATCH
    if grep -q avx2 /proc/cpuinfo; then
      build avx2 '' "$CC" -O3 -std=gnu99 -ffp-contract=off -mavx2 -mfma
      build native '' "$CC" -O3 -std=c99 -march=native
    fi ;;
esac
# A difference in the last digit of a double is seldom seen in what is said: so it is looked for where it is made.
if command -v objdump >/dev/null && test -e $out/native; then
  fused=$(objdump -d --no-show-raw-insn $out/native | grep -cE '[[:space:]]vfn?m(add|sub)')
  test "$fused" = 0 || { echo "one-path: native: $fused instructions are fused"; failed=1; }
fi
command -v clang >/dev/null && build clang '' clang -O2 -std=c99
# What cannot be kept is told.
if grep -q fma /proc/cpuinfo; then
  for cc in "$CC" clang; do
    command -v "$cc" >/dev/null || continue
    "$cc" -O2 -march=native -ffp-contract=fast -w -I. -DNSVCD_ONE_PATH -o $out/fast $program -lm
    $out/fast $meshes >$out/fast.txt 2>&1 && { echo "one-path: $cc fuses, and nothing says so"; failed=1; }
  done
fi
arch=aarch64
if command -v qemu-$arch >/dev/null && command -v $arch-linux-gnu-gcc >/dev/null; then
  build $arch "qemu-$arch -L /usr/$arch-linux-gnu" $arch-linux-gnu-gcc -O2 -std=c99
fi
# wasi-libc, and node's WASI
cat >$out/run.mjs <<'EOF'
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';
const wasi = new WASI({ version: 'preview1', args: process.argv.slice(2), preopens: { '.': '.' } });
const module = await WebAssembly.compile(await readFile(process.argv[2]));
process.exitCode = wasi.start(await WebAssembly.instantiate(module, { wasi_snapshot_preview1: wasi.wasiImport }));
EOF
if command -v node >/dev/null && echo 'int main(void) { return 0; }' | clang --target=wasm32-wasi -x c - -o $out/can.wasm 2>/dev/null; then
  # Without -fno-slp-vectorize clang 14 computes some coordinates wrongly: the page is built so, too.
  build wasm "node --no-warnings $out/run.mjs" clang --target=wasm32-wasi -O2 -msimd128 -fno-slp-vectorize -std=c99 -Wl,-z,stack-size=1048576
fi
test $failed = 0 && echo "one-path: $builds builds give the same bits"
exit $failed
