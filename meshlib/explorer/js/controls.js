// Native controls, for pages without a kernel.

import { element } from "./dom.js";

/** @import { Control, FilmSlider, Input, Made } from "./types" */

const TICK = 350;                                    // milliseconds between frames of a film

/** Menu or slider for one control of an atlas; the value of its input is the number of its option.
 * @type {(control: Omit<Control, "name">, initial: string, id: string) => Made} */
export function makeControl({ label, kind, texts, values }, initial, id) {
  const isMenu = kind === "menu", said = element("output", { htmlFor: id });
  /** @type {Input} */
  const input = isMenu
    ? element("select", { id },
              ...texts.map((textContent, value) => element("option", { textContent, value })))
    : element("input", { id, type: "range", min: 0, max: texts.length - 1, step: 1 });
  const tell = () => {
    said.textContent = texts[Number(input.value)];
    input.setAttribute("aria-valuetext", texts[Number(input.value)]);
  };
  const set = (/** @type {string | null} */ value) => {
    const number = value === null ? -1 : values.indexOf(value);
    if (number >= 0) input.value = String(number);
    if (!isMenu) tell();
  };
  set(initial);
  if (!isMenu) input.addEventListener("input", tell);
  const caption = element("label", { textContent: label, htmlFor: id });
  const row = element("div", { className: `control ${kind}` }, caption, input, isMenu ? "" : said);
  return { input, set, row };
}

/** The slider of the frames, and if they are a film a button that plays it.
 * @type {(film: string, id: string) => FilmSlider} */
export function makeFilm(film, id) {
  const label = film || "mesh", said = element("output", { htmlFor: id });
  const input = element("input", { id, type: "range", min: 0, max: 0, step: 1, value: 0 });
  const tell = () => {
    said.textContent = film ? `${input.value} of ${input.max}` : ["start", "adapted"][Number(input.value)];
    input.setAttribute("aria-valuetext", said.textContent);
  };
  input.addEventListener("input", tell);
  const player = makePlayer(input), caption = element("label", { textContent: label, htmlFor: id });
  const row = element("div", { className: `control slider${film ? " film" : ""}` },
                      caption, film ? player.button : "", input, said);
  return { input, row, tell, stop: player.stop };
}

/** Plays the frames of a slider; where motion is not wanted, each press is one frame.
 * @type {(input: HTMLInputElement) => { button: HTMLButtonElement, stop: () => void }} */
function makePlayer(input) {
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const button = element("button", { type: "button", className: "play" });
  let timer = 0;                                     // 0 while nothing is played
  const name = () => {
    button.textContent = timer ? "Pause" : still.matches ? "Next" : "Play";
  };
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    name();
  };
  const atEnd = () => Number(input.value) === Number(input.max);
  const go = (/** @type {number} */ frame) => {
    input.value = String(frame);
    input.dispatchEvent(new Event("input", { bubbles: true }));
    if (atEnd()) stop();
  };
  const advance = () => go(Number(input.value) + 1);
  const play = () => {
    if (atEnd()) go(0);
    timer = setInterval(advance, TICK);
    name();
  };
  button.addEventListener("click", () => {
    if (timer) stop();
    else if (!still.matches) play();
    else if (atEnd()) go(0);
    else advance();
  });
  still.addEventListener("change", stop);
  name();
  return { button, stop };
}
