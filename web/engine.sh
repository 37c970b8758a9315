#!/bin/sh
# Builds the engine into public/engine.wasm and the writer of PDF into public/pdf.wasm, with the toolchain that rustup or ./toolchain.sh gives.
#
# QUICK=1 builds faster: without optimising across crates, a larger and slower engine for tests.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/.." && pwd)
. "$here/toolchain.sh"
# In the engine's folder: elsewhere Cargo would build with the features of the program.
cd "$here/engine"
if [ -n "${QUICK:-}" ]; then
  export CARGO_PROFILE_PAGE_LTO=off CARGO_PROFILE_PAGE_OPT_LEVEL=1 CARGO_PROFILE_PAGE_CODEGEN_UNITS=8
fi
# Both in one run: what they share is compiled once.
cargo build --locked --profile page --target wasm32-unknown-unknown -p hodograph-wasm -p hodograph-wasm-pdf
built=${CARGO_TARGET_DIR:-$root/target}/wasm32-unknown-unknown/page
mkdir -p "$here/public"
cp "$root/crates/paper/fonts/song-gb1-cff.otf" "$here/public/song.otf"
optimiser=$here/node_modules/.bin/wasm-opt
place() {
  if [ -x "$optimiser" ] && [ -z "${QUICK:-}" ]; then
    "$optimiser" -Oz --enable-bulk-memory --enable-nontrapping-float-to-int --enable-sign-ext --enable-mutable-globals \
      --enable-multivalue --enable-reference-types "$built/$1" -o "$here/public/$2"
  else
    cp "$built/$1" "$here/public/$2"
  fi
  ls -l "$here/public/$2"
}
place hodograph_wasm.wasm engine.wasm
place hodograph_wasm_pdf.wasm pdf.wasm
