#!/bin/sh
# Builds the engine into public/engine.wasm, with the toolchain that rustup or ./toolchain.sh gives.
#
# PROFILE=page (the default) is small; PROFILE=dev builds faster and is large and slow.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/.." && pwd)
profile=${PROFILE:-page}
. "$here/toolchain.sh"
# In the engine's folder: elsewhere Cargo would build with the features of the program.
cd "$here/engine"
cargo build --locked --profile "$profile" --target wasm32-unknown-unknown
folder=$profile
[ "$profile" != dev ] || folder=debug
built=${CARGO_TARGET_DIR:-$root/target}/wasm32-unknown-unknown/$folder/hodograph_wasm.wasm
mkdir -p "$here/public"
cp "$root/crates/paper/fonts/song-gb1-cff.otf" "$here/public/song.otf"
optimiser=$here/node_modules/.bin/wasm-opt
if [ "$profile" = page ] && [ -x "$optimiser" ] && [ -z "${QUICK:-}" ]; then
  "$optimiser" -Oz --enable-bulk-memory --enable-nontrapping-float-to-int --enable-sign-ext --enable-mutable-globals \
    --enable-multivalue --enable-reference-types "$built" -o "$here/public/engine.wasm"
else
  cp "$built" "$here/public/engine.wasm"
fi
ls -l "$here/public/engine.wasm"
