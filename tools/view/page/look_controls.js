// What a visitor does: gestures on the picture, the strip of controls, keys.
import { any, input, placeOn } from "./dom.js";
import { listen } from "./gestures.js";
import { within } from "./live_view.js";
import { Tilt } from "./tilt.js";

/** @typedef {import("./live_view.js").LiveView} LiveView */

/**
 * A mark where the picture becomes sharp.
 * @param {LiveView} view @param {number} x @param {number} y in [0, 1) of the frame
 */
function focusAt(view, x, y) {
  const mark = any("mark");
  mark.hidden = true;
  placeOn(view.canvas, mark, x, y);
  void mark.offsetWidth; // the animation begins anew
  mark.hidden = false;
  void view.focusAt(x, y);
}

function help() {
  const dialog = /** @type {HTMLDialogElement} */ (any("help"));
  if (dialog.open) dialog.close();
  else dialog.showModal();
}

const fill = () => void (document.fullscreenElement ? document.exitFullscreen() : any("look").requestFullscreen());

/**
 * Whether the key means something here.
 * @param {LiveView} view @param {string} key @param {boolean} shift
 */
function press(view, key, shift) {
  /** @type {Record<string, [number, number]>} */
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const { focus, aperture } = view.camera;
  if (key in arrows) {
    const [x, y] = arrows[key];
    if (shift) view.turn(x / 40, y / 40);
    else view.move(x / 4, y / 4);
  } else if (key === "+" || key === "=") view.advance(0.25);
  else if (key === "-") view.advance(-0.25);
  else if (key === "[") view.change({ focus: within(focus - 0.05, -256, 256) });
  else if (key === "]") view.change({ focus: within(focus + 0.05, -256, 256) });
  else if (key === "a") view.slideTo({ aperture: (Math.floor(view.glide?.to.aperture ?? aperture) + 1) % 4 });
  else if (key === "f") fill();
  else if (key === "0") view.restart();
  else if (key === " ") view.setOff();
  else if (key === "?") help();
  else return false;
  return true;
}

/** @param {LiveView} view */
function show(view) {
  input("focus").value = String(view.camera.focus);
  input("blur").value = String(view.camera.aperture);
  any("motion").textContent = view.moving ? "Pause" : "Move";
}

/** @param {LiveView} view */
function prepareTilt(view) {
  const button = any("tilt");
  const { cols, rows } = view.facts;
  const tilt = new Tilt((x, y) => {
    view.sway = { u: 0.4 * x * (cols - 1), v: 0.4 * y * (rows - 1) };
    view.put({});
  });
  button.hidden = !Tilt.isThere();
  button.addEventListener("click", async () => {
    view.rest();
    button.setAttribute("aria-pressed", String(await tilt.toggle()));
  });
}

/**
 * @param {LiveView} view
 * @param {(x: number, y: number, alt: boolean) => boolean} takes whether somebody else takes a click
 */
export function control(view, takes = () => false) {
  const { cols, rows } = view.facts;
  listen(view.canvas, {
    move: (dx, dy) => view.move(-dx * Math.max(1, cols - 1), -dy * Math.max(1, rows - 1)),
    turn: (dx, dy) => view.turn(-dx, -dy),
    advance: (steps) => view.advance(steps / 4),
    click: (x, y, alt) => takes(x, y, alt) || focusAt(view, x, y),
  });
  const [near, far] = view.frames.depths;
  Object.assign(input("focus"), { min: near, max: far });
  input("focus").addEventListener("input", () => view.change({ focus: Number(input("focus").value) }));
  input("blur").addEventListener("input", () => view.change({ aperture: Number(input("blur").value) }));
  any("motion").addEventListener("click", () => view.setOff());
  any("middle").addEventListener("click", () => view.restart());
  any("full").addEventListener("click", fill);
  any("full").hidden = !document.fullscreenEnabled;
  any("keys").addEventListener("click", help);
  any("fold").addEventListener("click", () => {
    const open = any("look").classList.toggle("open");
    any("fold").setAttribute("aria-expanded", String(open));
  });
  addEventListener("keydown", (event) => {
    const { ctrlKey, altKey, metaKey, shiftKey, key, target } = event;
    if (ctrlKey || altKey || metaKey || any("look").hidden || !(target instanceof Element)) return;
    const letter = key.length === 1; // of which sliders take none
    const typing = letter && target.matches("input[type=range]") ? false : target.closest(key === "?" ? "input, select, aside" : "input, select, aside, dialog");
    if (typing || (key === " " && target instanceof HTMLButtonElement)) return;
    if (press(view, letter ? key.toLowerCase() : key, shiftKey)) event.preventDefault();
  });
  prepareTilt(view);
  view.changed = () => show(view);
  show(view);
  any("controls").hidden = false;
  any("fold").hidden = false;
}
