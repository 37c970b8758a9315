
  // ---- words, keys, colours: of every page that goes through steps and frames -----------------------------------------

  function speak() {
    document.documentElement.lang = data.tags[lang];
    document.title = $("title").textContent = pick(data.title);
    $("language").textContent = words().language;
    for (const e of document.querySelectorAll("[data-word]")) e.textContent = words()[e.dataset.word];
    for (const e of document.querySelectorAll("[data-title]")) e.title = words()[e.dataset.title];
    for (const e of document.querySelectorAll("[data-label]")) e.setAttribute("aria-label", words()[e.dataset.label]);
    spoken();
  }
  $("language").addEventListener("click", () => {
    lang = lang === "en" ? "zh" : "en";
    speak();
  });
  const theme = () => {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
  };
  $("theme").addEventListener("click", theme);
  // What has no construction has no steps.
  if ($("first")) {
    $("first").addEventListener("click", () => go(1));
    $("previous").addEventListener("click", () => go(step - 1));
    $("next").addEventListener("click", () => go(step + 1));
    $("last").addEventListener("click", () => {
      stepping = false;
      step = steps().length;
      showStep();
    });
  }
  const keys = {
    ArrowRight: () => go(step + 1),
    PageDown: () => go(step + 1),
    ArrowLeft: () => go(step - 1),
    PageUp: () => go(step - 1),
    Home: () => go(1),
    End: () => go(steps().length),
    "+": () => toFrame(frame + 1),
    "-": () => toFrame(frame - 1),
    " ": () => play(!running && !still.matches),
    l: () => $("language").click(),
    d: theme,
    ...ownKeys,
  };
  addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey || e.target.tagName === "INPUT" || !keys[e.key]) return;
    keys[e.key]();
    e.preventDefault();
  });

  speak();
  document.documentElement.dataset.ready = "";
})();
