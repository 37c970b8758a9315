#!/bin/sh
# Makes the embedded fonts anew, into the folder named by the first argument.
#
# Needs npm, apt-get (Debian 12), and Python with fonttools 4.68 and brotli: pip install fonttools==4.68.0 brotli.
# The characters of each subset are read from the font that is checked in here: to add one, name it in EXTRA.
# Characters, outlines and advances come out the same; dates and name tables differ from the checked-in files.
set -eu

out=${1:?usage: make-subsets.sh OUTPUT-FOLDER}
here=$(cd "$(dirname "$0")" && pwd)
EXTRA=${EXTRA:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
out=$(cd "$out" && pwd)

characters() { # of a font, as U+ numbers, one a line
    python3 -c 'import sys
from fontTools.ttLib import TTFont
points = set(TTFont(sys.argv[1]).getBestCmap()) | {ord(c) for c in sys.argv[2]}
print("\n".join(f"U+{p:04X}" for p in sorted(points)))' "$1" "$EXTRA"
}

cd "$work"
npm pack --silent @fontsource/tinos@5.3.0 @fontsource/stix-two-math@5.3.0 >/dev/null
for archive in fontsource-*.tgz; do
    mkdir "${archive%.tgz}"
    tar -xzf "$archive" -C "${archive%.tgz}" --strip-components=1
done
apt-get download fonts-noto-cjk=1:20220127+repack1-1
dpkg-deb -x fonts-noto-cjk_*.deb noto

woff() { # FONTSOURCE-FOLDER FILE: a woff2 file as an sfnt, on standard output's name
    python3 -c 'import sys
from fontTools.ttLib import TTFont
font = TTFont(sys.argv[1]); font.flavor = None; font.save(sys.argv[2])' "$1" "$2"
}

for style in normal italic; do
    for part in latin greek; do
        woff fontsource-tinos-5.3.0/files/tinos-$part-400-$style.woff2 tinos-$part-$style.ttf
    done
    pyftmerge --output-file=tinos-$style.ttf tinos-latin-$style.ttf tinos-greek-$style.ttf
    # Whatever else the files carry, hints and names included, stays as merged.
    cp tinos-$style.ttf "$out/tinos-$style.ttf"
done

woff fontsource-tinos-5.3.0/files/tinos-latin-700-italic.woff2 tinos-bold-italic.ttf
pyftsubset tinos-bold-italic.ttf --unicodes=U+0041-005A,U+0061-007A --layout-features=kern --no-hinting --notdef-outline \
    --output-file="$out/tinos-bold-italic.ttf"

characters "$here/stix-math-sub.ttf" >stix.txt
woff "$(ls fontsource-stix-two-math-5.3.0/files/stix-two-math-latin-400-normal.woff2)" stix.ttf
pyftsubset stix.ttf --unicodes-file=stix.txt --layout-features=kern,ssty --drop-tables+=MATH --no-hinting --desubroutinize --notdef-outline \
    --output-file="$out/stix-math-sub.ttf"

for face in upright:normal italic:italic; do
    python3 "$here/page-fonts.py" "$out/tinos-${face#*:}.ttf" "${face%:*}" fontsource-stix-two-math-5.3.0/files/stix-two-math-latin-400-normal.woff2 \
        "$out/page-${face%:*}.woff2"
done

characters "$here/song-gb1-cff.otf" >song.txt
pyftsubset noto/usr/share/fonts/opentype/noto/NotoSerifCJK-Regular.ttc --font-number=2 --unicodes-file=song.txt \
    --layout-features= --drop-tables+=vhea,vmtx,VORG --no-hinting --desubroutinize --notdef-outline --output-file="$out/song-gb1-cff.otf"

ls -l "$out"
