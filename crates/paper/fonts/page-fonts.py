"""Fonts for pages, as woff2: letters, digits and signs of Tinos, with the constants of STIX Two Math for setting formulas.

page-fonts.py TINOS UPRIGHT|ITALIC STIX OUT
"""
import sys

from fontTools import subset
from fontTools.ttLib import TTFont, newTable
from fontTools.ttLib.tables import otTables

source, kind, stix, out = sys.argv[1:]
characters = set(range(0x20, 0x7F)) | set(range(0x391, 0x3CA))
if kind == "upright":
    characters |= {ord(c) for c in "°·×−–²³±½"}
font = TTFont(source)
options = subset.Options(hinting=False, layout_features=["kern"], name_IDs=[0, 1, 2, 3, 4, 5, 6, 13, 14], notdef_outline=True)
subsetter = subset.Subsetter(options)
subsetter.populate(unicodes=characters)
subsetter.subset(font)

if kind == "upright":
    # Browsers set scripts and fractions by this table, and without one high above the line.
    given = TTFont(stix)
    scale = font["head"].unitsPerEm / given["head"].unitsPerEm
    constants = given["MATH"].table.MathConstants
    for name, value in vars(constants).items():
        if isinstance(value, otTables.MathValueRecord):
            value.Value, value.DeviceTable = round(value.Value * scale), None
        elif "Percent" not in name and isinstance(value, int):
            setattr(constants, name, round(value * scale))
    # As in the figures: indices stand close to their letter, and not far below it.
    constants.SpaceAfterScript.Value = round(0.01 * font["head"].unitsPerEm)
    constants.SubscriptShiftDown.Value = round(0.17 * font["head"].unitsPerEm)
    math = newTable("MATH")
    math.table = otTables.MATH()
    math.table.Version = 0x00010000
    math.table.MathConstants = constants
    # Empty, but there: browsers take no table without them.
    math.table.MathGlyphInfo = otTables.MathGlyphInfo()
    for part in ("MathItalicsCorrectionInfo", "MathTopAccentAttachment", "ExtendedShapeCoverage", "MathKernInfo"):
        setattr(math.table.MathGlyphInfo, part, None)
    math.table.MathVariants = variants = otTables.MathVariants()
    variants.MinConnectorOverlap = variants.VertGlyphCount = variants.HorizGlyphCount = 0
    variants.VertGlyphCoverage = variants.HorizGlyphCoverage = None
    variants.VertGlyphConstruction, variants.HorizGlyphConstruction = [], []
    font["MATH"] = math
font.flavor = "woff2"
font.save(out)
