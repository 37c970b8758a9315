"""Reads exported files back with the programs they are for, and compares the places of the joints.

read_back.py KIND FILE TABLE: the table is a sweep with the places of the joints at every degree of
the crank, in columns x_A, y_A, ...  Prints `missing` where the program is not installed.
"""

import csv
import json
import math
import re
import sys
import zipfile
import xml.etree.ElementTree as xml


def rows(path):
    """The rows of a sweep, in mm, without the units in the names."""
    with open(path, encoding="utf-8") as table:
        return [{n.split(" ")[0]: 1e3 * float(v) for n, v in row.items()} for row in csv.DictReader(table)]


def compared(poses, table, steps):
    """The greatest distance (mm) of joints from the table; `poses` are by row, from the first."""
    worst, found = 0.0, set()
    for k in range(steps):
        for name, (x, y) in poses[k].items():
            told = table[k]
            if f"x_{name}" in told:
                found.add(name)
                worst = max(worst, abs(x - told[f"x_{name}"]), abs(y - told[f"y_{name}"]))
    asked = {n[2:] for n in table[0] if n.startswith("x_")}
    assert found == asked, asked - found
    return worst


def pylinkage_script(path, table):
    scope = {"__name__": "read_back"}
    exec(compile(open(path, encoding="utf-8").read(), path, "exec"), scope)
    joints, linkage = scope["joints"], scope["linkage"]
    poses = [{n: (j.x, j.y) for n, j in joints.items()}]
    for _ in linkage.step(iterations=len(table) - 1):
        poses.append({n: (j.x, j.y) for n, j in joints.items()})
    # Points of the crank have no place before the first step.
    poses[0] = {n: at for n, at in poses[0].items() if at[0] is not None}
    return compared(poses, table, len(table)), len(joints)


def pylinkage_file(path, table):
    from pylinkage.mechanism import mechanism_from_json

    mechanism = mechanism_from_json(path)
    place = lambda: {j.id: j.position for j in mechanism.joints}
    poses = [place()]
    for _ in mechanism.step(len(table) - 1):
        poses.append(place())
    return compared(poses, table, len(table)), len(mechanism.joints)


class Construction:
    """Evaluates the commands of geogebra.xml that the writer uses."""

    def __init__(self, root):
        self.root, self.value = root, {}

    def expression(self, text):
        names = {}

        def named(match):
            key = f"n{len(names)}"
            names[key] = self.value[match.group(0)]
            return key

        label = r"[^\W\d_]+'?(?:_\{[^}]*\})?(?!\()"
        body = re.sub(label, lambda m: named(m) if m.group(0) in self.value else m.group(0), text)
        body = re.sub(r"\b(x|y)\(", lambda m: f"of_{m.group(1)}(", pairs(body))
        return eval(body, {**names, "of_x": lambda p: p.x, "of_y": lambda p: p.y, "V": V, "__builtins__": {}})

    def run(self, drag):
        """All values; `drag` turns the point of the crank's circle by an angle."""
        held = {e.get("label"): e for e in self.root.iter("element")}
        for item in self.root.find("construction"):
            if item.tag == "element" and item.get("label") not in self.value:
                label = item.get("label")
                if item.get("type") == "numeric":
                    self.value[label] = float(item.find("value").get("val"))
                elif item.get("type") == "point":
                    c = item.find("coords")
                    self.value[label] = V(float(c.get("x")), float(c.get("y")))
            elif item.tag == "expression":
                self.value[item.get("label")] = self.expression(item.get("exp"))
            elif item.tag == "command":
                given = [item.find("input").get(f"a{k}") for k in range(len(item.find("input").attrib))]
                out = [item.find("output").get(f"a{k}") for k in range(len(item.find("output").attrib))]
                self.command(item.get("name"), given, out, held, drag)
        return self.value

    def command(self, name, given, out, held, drag):
        v = self.value
        if name == "Circle":
            v[out[0]] = ("circle", v[given[0]], v[given[1]])
        elif name == "Line" and v[given[1]].__class__ is V:
            v[out[0]] = ("line", v[given[0]], v[given[1]] - v[given[0]])
        elif name == "Line":
            v[out[0]] = ("line", v[given[0]], v[given[1]][2])
        elif name == "Segment":
            v[out[0]] = ("line", v[given[0]], v[given[1]] - v[given[0]])
        elif name == "OrthogonalLine":
            d = v[given[1]][2]
            v[out[0]] = ("line", v[given[0]], V(-d.y, d.x))
        elif name == "Point":
            _, centre, radius = v[given[0]]
            c = held[out[0]].find("coords")
            at = V(float(c.get("x")), float(c.get("y"))) - centre
            angle = math.atan2(at.y, at.x) + drag
            v[out[0]] = centre + V(radius * math.cos(angle), radius * math.sin(angle))
        elif name == "Distance":
            d = v[given[1]] - v[given[0]]
            v[out[0]] = math.hypot(d.x, d.y)
        elif name == "Intersect":
            found = crossings(v[given[0]], v[given[1]])
            # The order of two crossings is that of no program.
            v.update(zip(out, found[::-1]))
        elif name == "If":
            v[out[0]] = v[given[1]] if self.expression(given[0]) else v[given[2]]
        elif name == "Vector":
            v[out[0]] = v[given[1]] - v[given[0]]
        elif name == "Polygon":
            v[out[0]] = None
        else:
            raise ValueError(name)


def pairs(text):
    """Pairs `(a, b)` as vectors: an opening bracket whose partner holds a comma at its own depth."""
    out, stack = list(text), []
    for i, c in enumerate(text):
        if c == "(":
            stack.append([i, False])
        elif c == "," and stack:
            stack[-1][1] = True
        elif c == ")":
            start, two = stack.pop()
            if two:
                out[start] = "V("
    return "".join(out)


class V:
    def __init__(self, x, y):
        self.x, self.y = x, y

    def __add__(self, o):
        return V(self.x + o.x, self.y + o.y)

    def __sub__(self, o):
        return V(self.x - o.x, self.y - o.y)

    def __rmul__(self, k):
        return V(k * self.x, k * self.y)


def crossings(a, b):
    if a[0] == "line" and b[0] == "line":
        (_, p, u), (_, q, w) = a, b
        t = ((q.x - p.x) * w.y - (q.y - p.y) * w.x) / (u.x * w.y - u.y * w.x)
        return [p + V(t * u.x, t * u.y)]
    if b[0] == "line":
        (_, c, r), (_, p, u) = a, b
        n = math.hypot(u.x, u.y)
        u = V(u.x / n, u.y / n)
        t = (c.x - p.x) * u.x + (c.y - p.y) * u.y
        foot = p + V(t * u.x, t * u.y)
        h = math.sqrt(r * r - (foot.x - c.x) ** 2 - (foot.y - c.y) ** 2)
        return [foot + V(-h * u.x, -h * u.y), foot + V(h * u.x, h * u.y)]
    (_, p, r), (_, q, s) = a, b
    d = math.hypot(q.x - p.x, q.y - p.y)
    along = (r * r - s * s + d * d) / (2 * d)
    h = math.sqrt(r * r - along * along)
    u = V((q.x - p.x) / d, (q.y - p.y) / d)
    foot = p + V(along * u.x, along * u.y)
    return [foot + V(-h * u.y, h * u.x), foot + V(h * u.y, -h * u.x)]


def geogebra(path, table):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        root = xml.fromstring(archive.read("geogebra.xml"))
    labels = [e.get("label") for e in root.iter("element")]
    assert len(labels) == len(set(labels)), [n for n in labels if labels.count(n) > 1]
    poses, speeds = [], 0.0
    sense = 1 if float(root.find(".//element[@label='ω']/value").get("val")) > 0 else -1
    dt = 1e-5
    for k in range(len(table)):
        drag = sense * math.radians(k)
        value = Construction(root).run(drag)
        name = lambda label: re.sub(r"[_{}]", "", label)
        places = {n: v for n, v in value.items() if isinstance(v, V)}
        poses.append({name(n): (v.x, v.y) for n, v in places.items() if not n.startswith(("p_", "v_", "X_"))})
        if k % 40 == 0:
            later, sooner = (Construction(root).run(drag + sense * t) for t in (dt, -dt))
            scale = value["k"] * abs(value["ω"])
            for n, v in value.items():
                if n.startswith("v_"):
                    of = next(m for m in places if name(m) == name(n)[1:])
                    d = later[of] - sooner[of]
                    speeds = max(speeds, abs(v.x - scale * d.x / (2 * dt)), abs(v.y - scale * d.y / (2 * dt)))
    assert speeds < 1e-4, f"the velocity polygon is off by {speeds} mm"
    return compared(poses, table, len(table)), len(poses[0])


def dxf(path):
    """Layers with the number of their entities, the centres of the joints, texts and lines."""
    from ezdxf import recover

    # Only this reader takes characters by their numbers in Unicode, as drawing programs do.
    drawing, audit = recover.readfile(path)
    faults = [e.message for e in audit.errors]
    assert not faults, faults
    layers, joints, texts, lines = {}, [], [], []
    for e in drawing.modelspace():
        layers[e.dxf.layer] = layers.get(e.dxf.layer, 0) + 1
        if e.dxftype() == "CIRCLE" and e.dxf.layer == "JOINTS":
            joints.append([e.dxf.center.x, e.dxf.center.y])
        if e.dxftype() == "TEXT":
            texts.append(e.plain_text())
        if e.dxftype() == "LINE" and e.dxf.layer in ("VELOCITY", "ACCELERATION"):
            lines.append([*e.dxf.start.vec2, *e.dxf.end.vec2])
    return {"layers": layers, "joints": joints, "texts": texts, "lines": lines}


def pptx(path):
    """Title, sentence and pictures of each slide."""
    from pptx import Presentation

    slides = []
    for slide in Presentation(path).slides:
        texts = [s.text_frame.text for s in slide.placeholders]
        pictures = [s for s in slide.shapes if s.shape_type == 13]
        ends = [(p.left + p.width, p.top + p.height) for p in pictures]
        slides.append({"texts": texts, "pictures": [p.image.content_type for p in pictures], "ends": ends})
    return slides


def typ(path):
    """The pages of a Typst document as SVG."""
    import typst

    pages = typst.compile(path, format="svg")
    return [page.decode() for page in (pages if isinstance(pages, list) else [pages])]


def main():
    kind, path = sys.argv[1:3]
    try:
        if kind in ("dxf", "pptx", "typ"):
            print(json.dumps({"dxf": dxf, "pptx": pptx, "typ": typ}[kind](path)))
            return
        table = rows(sys.argv[3])
        worst, count = {"py": pylinkage_script, "json": pylinkage_file, "ggb": geogebra}[kind](path, table)
    except ModuleNotFoundError as e:
        print("missing", e.name)
        return
    print(json.dumps({"worst_mm": worst, "joints": count}))


main()
