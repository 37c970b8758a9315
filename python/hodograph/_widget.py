"""Figures with a slider for the driver, in notebooks."""

from __future__ import annotations

from typing import Any

from ._errors import HodographError
from ._problem import Scene

_SCRIPT = """
export default { render({ model, el }) {
  const figures = document.createElement("div");
  figures.style.cssText = "display:flex;flex-wrap:wrap;align-items:flex-start;gap:1em;background:white";
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: model.get("low"), max: model.get("high"), step: "any" });
  slider.style.width = "100%";
  slider.setAttribute("aria-label", model.get("name"));
  const label = document.createElement("div");
  const shadows = [];
  const show = () => {
    const pages = model.get("pages");
    while (shadows.length < pages.length) {
      const page = document.createElement("div");
      figures.append(page);
      // Ids of several figures do not meet in shadows of their own.
      shadows.push(page.attachShadow({ mode: "open" }));
    }
    pages.forEach((svg, k) => { shadows[k].innerHTML = svg; });
    label.textContent = model.get("words");
  };
  let waits = false, wanted = null;
  const send = () => {
    if (waits || wanted === null) return;
    waits = true;
    model.set("value", wanted);
    wanted = null;
    model.save_changes();
  };
  slider.value = model.get("value");
  slider.addEventListener("input", () => { wanted = Number(slider.value); send(); });
  model.on("change:drawn", () => { waits = false; show(); send(); });
  show();
  el.append(slider, label, figures);
} };
"""


def widget(scene: Scene, names: tuple[str, ...], options: dict[str, Any]) -> Any:
    """The widget of a scene; the driver moves through a turn, or through its travel."""
    import anywidget
    import traitlets

    there = []
    for name in names:
        try:
            scene.figure(name)
        except HodographError:
            continue
        there.append(name)
    live = scene.live(*there, **options)
    table = scene.sweep(options.get("over"), steps=360)
    column, values = next(iter(table.items()))
    unit = table.units[column]
    factor = 57.29577951308232 if unit == "rad" else 1e3 if unit == "m" else 1.0
    word = {"rad": "°", "m": " mm"}.get(unit, f" {unit}")
    start = live.values[0] if unit != "s" else float(values[0])

    class Crank(anywidget.AnyWidget):
        _esm = _SCRIPT
        name = traitlets.Unicode(column).tag(sync=True)
        low = traitlets.Float(float(values[0])).tag(sync=True)
        high = traitlets.Float(float(values[-1])).tag(sync=True)
        value = traitlets.Float(start).tag(sync=True)
        pages = traitlets.List(list(live.svgs.values())).tag(sync=True)
        words = traitlets.Unicode("").tag(sync=True)
        drawn = traitlets.Int(0).tag(sync=True)

        @traitlets.observe("value")
        def _moved(self, _: Any = None) -> None:
            place = f"{column} = {self.value * factor:.1f}{word}"
            try:
                live.travel(self.value - start)
                answers = "; ".join(f"{find} = {text}" for find, text in live.answers.items())
                self.pages, self.words = list(live.svgs.values()), f"{place}: {answers}"
            except HodographError as fault:
                self.words = f"{place}: {fault.diagnostics[0].message['en']}"
            self.drawn += 1

    crank = Crank()
    crank.live = live
    crank._moved()
    return crank
