
  // ---- sheets for the printer, and the window of the speaker ------------------------------------------------------
  // A page says by `stage(k)` what is seen and said at a step, and by `answersNow()` the answers.

  /** A drawing as it is seen at a step: without what later steps add, without what is moved by hand, without ids. */
  function pictureOf(svg) {
    const copy = svg.cloneNode(true);
    const gone = (e) => e.getAttribute("display") === "none" || e.style.display === "none";
    for (const e of [...copy.querySelectorAll("*")]) if (gone(e) || e.matches(".later, .grip, .tip, .over, .under")) e.remove();
    for (const e of [copy, ...copy.querySelectorAll("[id]")]) e.removeAttribute("id");
    return copy;
  }

  /** What is seen and said at a step as one element. */
  function card(k, name) {
    const { pictures, html } = stage(k);
    const item = document.createElement(name);
    const box = document.createElement("div");
    box.className = "picture ink-of-step";
    box.append(...pictures.map(pictureOf));
    const text = document.createElement("div");
    text.innerHTML = `<b>${k}</b> ${html}`;
    item.append(box, text);
    return item;
  }

  /** The sheets: a card for each step, six on a page. */
  const sheets = (count) => $("all").replaceChildren(...[...Array(count).keys()].map((k) => card(k + 1, "li")));

  /** Where a drawing is larger than its place, the step is in the middle. */
  function middle(figure) {
    if (figure.scrollWidth <= figure.clientWidth + 1 && figure.scrollHeight <= figure.clientHeight + 1) return;
    const shown = [...figure.querySelectorAll(".now")].filter((e) => e.getBoundingClientRect().width > 0);
    const [r, b] = [shown[0] || figure.querySelector("svg"), figure].map((e) => e.getBoundingClientRect());
    figure.scrollLeft += r.left + r.width / 2 - b.left - b.width / 2;
    figure.scrollTop += r.top + r.height / 2 - b.top - b.height / 2;
  }

  let desk = null;
  let since = 0;

  /** Opens the speaker's window beside the page: the step, what is said at it, what comes next, the answers, a clock. */
  function speaker() {
    if (desk && !desk.closed) return desk.focus();
    desk = open("", "", "width=1000,height=700");
    if (!desk) return;
    const d = desk.document;
    const style = [...document.querySelectorAll("style")].map((e) => e.textContent).join("");
    d.head.innerHTML = `<meta charset="utf-8"><style>${style}</style>`;
    d.body.className = "desk";
    d.body.innerHTML = `<header><span id="count"></span><output id="clock"></output></header><main><section id="now"></section><section id="coming"></section><ul id="answers"></ul></main>`;
    d.body.prepend(document.querySelector(".letters").cloneNode(true));
    since = Date.now();
    desk.addEventListener("keydown", (e) => {
      if (e.key.toLowerCase() === "s") return desk.close();
      dispatchEvent(new KeyboardEvent("keydown", { key: e.key, shiftKey: e.shiftKey }));
      e.preventDefault();
    });
    const tick = () => {
      if (desk.closed) return clearInterval(ticking);
      const s = Math.floor((Date.now() - since) / 1000);
      d.getElementById("clock").textContent = `${Math.floor(s / 60)}:${String(s % 60).padStart(2, "0")}`;
    };
    const ticking = setInterval(tick, 500);
    addEventListener("pagehide", () => desk.close());
    tick();
    note();
  }

  /** Writes the speaker's window anew. */
  function note() {
    if (!desk || desk.closed) return;
    const d = desk.document;
    const { pictures, html, next } = noted();
    d.documentElement.lang = document.documentElement.lang;
    d.documentElement.dataset.theme = document.documentElement.dataset.theme || "";
    d.title = document.title;
    d.getElementById("count").textContent = $("count").textContent;
    const now = d.getElementById("now");
    now.innerHTML = html;
    const box = d.createElement("div");
    box.className = "picture";
    box.append(...pictures.map((svg) => d.importNode(pictureOf(svg), true)));
    now.append(box);
    d.getElementById("coming").innerHTML = next ? `<h2>${tellNext()}</h2>${next}` : "";
    d.getElementById("answers").innerHTML = answersNow();
  }
