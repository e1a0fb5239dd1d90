// Native controls, for pages without a kernel.

const TICK = 350;                                    // milliseconds between frames of a film

// Menu or slider for one control of an atlas; the value of its input is the number of its option.
function makeControl({ label, kind, texts, values }, initial, id) {
  const isMenu = kind === "menu", said = element("output", { htmlFor: id });
  const input = isMenu
    ? element("select", { id },
              ...texts.map((textContent, value) => element("option", { textContent, value })))
    : element("input", { id, type: "range", min: 0, max: texts.length - 1, step: 1 });
  const tell = () => {
    said.textContent = texts[input.value];
    input.setAttribute("aria-valuetext", texts[input.value]);
  };
  const set = (value) => {
    if (values.includes(value)) input.value = values.indexOf(value);
    if (!isMenu) tell();
  };
  set(initial);
  if (!isMenu) input.addEventListener("input", tell);
  const caption = element("label", { textContent: label, htmlFor: id });
  const row = element("div", { className: `control ${kind}` }, caption, input, isMenu ? "" : said);
  return { input, set, row };
}

// The slider of the frames, and if they are a film a button that plays it.
function makeFilm(film, id) {
  const label = film || "mesh", plain = { label, kind: "slider", texts: ["0"], values: ["0"] };
  const { input, row } = makeControl(plain, "0", id), said = row.querySelector("output");
  const tell = () => {
    said.textContent = film ? `${input.value} of ${input.max}` : ["start", "adapted"][input.value];
    input.setAttribute("aria-valuetext", said.textContent);
  };
  input.addEventListener("input", tell);
  const player = makePlayer(input);
  if (film) {
    row.classList.add("film");
    row.insertBefore(player.button, input);
  }
  return { input, row, tell, stop: player.stop };
}

// Plays the frames of a slider; where motion is not wanted, each press is one frame.
function makePlayer(input) {
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const button = element("button", { type: "button", className: "play" });
  let timer = null;
  const name = () => (button.textContent = timer ? "Pause" : still.matches ? "Next" : "Play");
  const stop = () => (clearInterval(timer), timer = null, name());
  const atEnd = () => Number(input.value) === Number(input.max);
  const go = (frame) => {
    input.value = frame;
    input.dispatchEvent(new Event("input", { bubbles: true }));
    if (atEnd()) stop();
  };
  const advance = () => go(Number(input.value) + 1);
  button.addEventListener("click", () => {
    if (timer) stop();
    else if (still.matches) (atEnd() ? go(0) : advance());
    else {
      if (atEnd()) go(0);
      timer = setInterval(advance, TICK);
      name();
    }
  });
  still.addEventListener("change", stop);
  name();
  return { button, stop };
}
