# To be sourced: gives Cargo the target wasm32-unknown-unknown. Where rustup cannot fetch it, Debian's compiler for it is
# unpacked into target/wasm-toolchain, without root, and its standard library is built once (70 s of the processor).
#
# Needs for that: apt-get of Debian 12 with its security updates or later, dpkg-deb, cargo, and rustup's rust-lld or Debian's lld.
wasm_toolchain() {
  if rustup target add wasm32-unknown-unknown >/dev/null 2>&1; then return; fi
  dir=$1
  if [ ! -e "$dir/env" ]; then
    rm -rf "$dir" && mkdir -p "$dir/debs"
    (
      cd "$dir/debs"
      std=$(apt-cache depends libstd-rust-web-dev | grep -o 'libstd-rust-web-[0-9][0-9.]*' | head -1)
      llvm=$(apt-cache depends "$std" | grep -o 'libllvm[0-9][0-9]*' | head -1)
      apt-get download rustc-web rust-web-src libstd-rust-web-dev "$std" "$llvm" >/dev/null
      for deb in *.deb; do dpkg-deb -x "$deb" "$dir"; done
    )
    cat >"$dir/rustc" <<END
#!/bin/sh
LD_LIBRARY_PATH=$dir/usr/lib/$(uname -m)-linux-gnu\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH} exec $dir/usr/bin/rustc --sysroot $dir/usr "\$@"
END
    chmod +x "$dir/rustc"
    lld=$(ls "$(rustc --print sysroot)"/lib/rustlib/*/bin/rust-lld 2>/dev/null | head -1 || true)
    lld=${lld:-$(command -v wasm-ld)}
    # The few crates of the standard library come from the registry by its own lock file: the package's vendor folder lacks those
    # of its tests, so that --offline cannot resolve.
    (
      cd "$dir"/usr/src/rustc-*/library
      RUSTC="$dir/rustc" RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR="$dir/std" CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER="$lld" \
        RUSTFLAGS="-Zforce-unstable-if-unmarked -Cembed-bitcode=yes --remap-path-prefix=$PWD=/rustc/library" \
        cargo build --release --manifest-path sysroot/Cargo.toml --target wasm32-unknown-unknown
      to=$dir/usr/lib/rustlib/wasm32-unknown-unknown/lib
      mkdir -p "$to"
      cp "$dir"/std/wasm32-unknown-unknown/release/deps/*.rlib "$to/"
    )
    rm -rf "$dir/std"
    printf 'export RUSTC=%s\nexport CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=%s\n' "$dir/rustc" "$lld" >"$dir/env"
  fi
  . "$dir/env"
}
wasm_toolchain "$root/target/wasm-toolchain"
