  // ---- words ------------------------------------------------------------------------------------------------------

  // Formulas and sentences of the frames, in both languages; see bank.rs.

  let lang = data.lang;
  const other = { en: "zh", zh: "en" };
  const word = (key, ...fills) => fills.reduce((text, f, i) => text.replace(`{${i}}`, () => f).replace("{}", () => f), data.words[lang][key]);
  const which = () => (lang === "en" ? 0 : 1);

  /** Tags in the place of their signs; see bank.rs. */
  const tagged = (text) => text.replace(/[\uE010-\uE02F]/g, (c) => data.tags[c.charCodeAt(0) - 0xe010]);
  const formulaList = data.formulas.map(tagged);

  /** Formulas in the place of their indices. */
  const formulas = (text) => tagged(text).replace(/\uE001(\d+)\uE002/g, (_, n) => formulaList[n]);

  /** A sentence of a frame; see bank.rs. */
  function sayer([en, zh]) {
    const open = (told, numbers) => {
      const [written, sequence] = told;
      const forms = written.map(formulas);
      const holes = forms.map((f) => f.split("\uE000").length - 1);
      const list = numbers === "" ? [] : numbers.split(" ");
      const frames = [];
      let next = 0;
      for (const form of stretched(sequence === 0 ? [0, count] : sequence)) {
        frames.push(form < 0 ? null : [form, next]);
        if (form >= 0) next += holes[form];
      }
      return (k) => {
        if (!frames[k]) return "";
        let [form, at] = frames[k];
        return forms[form].split("\uE000").reduce((text, piece) => text + list[at++] + piece);
      };
    };
    const says = { en: open(en, en[2]), zh: open(zh, zh[2] === 0 ? en[2] : zh[2]) };
    return (k) => says[lang](k);
  }

  const steps = data.steps.map(([key, n, en, zh]) => ({ key, level: drawing(key).level, n, say: sayer([en, zh]) }));
  const equations = data.equations;
  const variants = stretched(equations.frames === 0 ? [0, count] : equations.frames);

  /** The equation that a step of a frame solves, what the step draws of it marked; see equations.rs. In a prediction it
      hides the directions of what is not drawn yet (1), and of what is asked (2). */
  function equation(of, k, hides) {
    const told = of && variants[k] >= 0 ? equations.variants[variants[k]][of.level] : [];
    if (!told[of?.n]) return { index: -1, html: "", most: 1 };
    const [index, ...now] = told[of.n];
    const columns = equations.written[index];
    if (columns.line && hides === 2) return { index: -1, html: "", most: 1 };
    if (columns.line) return { index, html: `<p>${formulas(columns.line[which()])}</p>`, most: 1 };
    const later = told.slice(of.n + 1).flatMap((t) => (t && t[0] === index ? t.slice(1) : []));
    const face = (c) => (now.includes(c) ? "now" : later.includes(c) ? "later" : "");
    const [magnitude, direction] = data.rows[which()];
    const [second, third] = [[magnitude, 3], [direction, 2]][equations.direction_first ? "reverse" : "slice"]();
    const part = (from, to) => {
      const row = ([head, part]) => {
        const hidden = (n, c) => hides && part === 2 && n >= 0 && (later.includes(c) || (hides === 2 && now.includes(c)));
        const cell = (n, c) => `<td class="${face(c)}">${hidden(n, c) ? "?" : n < 0 ? "" : formulaList[n]}</td>`;
        const sign = (n) => `<td>${n < 0 || part > 1 ? "" : formulaList[n]}</td>`;
        const cells = columns.map((c, i) => (i < from || i >= to ? "" : (i ? sign(c[0]) : "") + cell(c[part], i)));
        return `<tr><th scope="row">${head}</th>${cells.join("")}</tr>`;
      };
      return `<table class="equation">${[["", 1], second, third].map(row).join("")}</table>`;
    };
    const html = (lines) => {
      const each = Math.ceil(columns.length / lines);
      return [...Array(lines).keys()].map((i) => part(i * each, (i + 1) * each)).join("");
    };
    return { index, html: html(1), html_in: html, most: columns.length };
  }

  /** What an action of a step is about; see acts.rs. */
  function act(of, k) {
    const list = of && variants[k] >= 0 ? equations.acts[variants[k]][of.level] : [];
    const told = list[of?.n];
    if (!told) return null;
    const [kind, links, point, seen, sense, symbol, direction, line, rate] = told;
    return { kind, links, point, seen, sense, symbol, direction, line, rate };
  }

  const answers = data.answers.map((a) => sayer(a));
  const answerItems = answers.map(() => $("answers").appendChild(document.createElement("li")));

