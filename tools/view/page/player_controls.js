// What a visitor does: gestures on the picture, the strip of controls, keys.
import { any, input } from "./dom.js";
import { listen } from "./gestures.js";
import { within } from "./live_view.js";
import { Tilt } from "./tilt.js";

/** @typedef {import("./live_view.js").LiveView} LiveView */

/**
 * Where the frame is on its canvas: object-fit leaves room aside or above.
 * @param {HTMLCanvasElement} canvas
 */
function frameBox({ clientWidth, clientHeight, width, height }) {
  const scale = Math.min(clientWidth / width, clientHeight / height);
  const size = { width: width * scale, height: height * scale };
  return { ...size, left: (clientWidth - size.width) / 2, top: (clientHeight - size.height) / 2 };
}

/**
 * A mark where the picture becomes sharp.
 * @param {LiveView} view @param {number} x @param {number} y in [0, 1) of the canvas
 */
function focusAt(view, x, y) {
  const box = frameBox(view.canvas);
  const [left, top] = [x * view.canvas.clientWidth, y * view.canvas.clientHeight];
  const [px, py] = [(left - box.left) / box.width, (top - box.top) / box.height];
  if (!(px >= 0 && px < 1 && py >= 0 && py < 1)) return;
  const mark = any("mark");
  mark.hidden = true;
  mark.style.left = `${left}px`;
  mark.style.top = `${top}px`;
  void mark.offsetWidth; // the animation begins anew
  mark.hidden = false;
  void view.focusAt(px, py);
}

const help = () => /** @type {HTMLDialogElement} */ (any("help")).showModal();

const fill = () => void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());

/** @param {LiveView} view */
const restart = (view) => view.change(view.beginning());

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
  else if (key === "0") restart(view);
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

/** @param {LiveView} view */
export function control(view) {
  const { cols, rows } = view.facts;
  listen(view.canvas, {
    move: (dx, dy) => view.move(-dx * Math.max(1, cols - 1), -dy * Math.max(1, rows - 1)),
    turn: (dx, dy) => view.turn(-dx, -dy),
    advance: (steps) => view.advance(steps / 4),
    click: (x, y) => focusAt(view, x, y),
  });
  const { near, far } = document.body.dataset;
  Object.assign(input("focus"), { min: near, max: far });
  input("focus").addEventListener("input", () => view.change({ focus: Number(input("focus").value) }));
  input("blur").addEventListener("input", () => view.change({ aperture: Number(input("blur").value) }));
  any("motion").addEventListener("click", () => view.setOff());
  any("middle").addEventListener("click", () => restart(view));
  any("full").addEventListener("click", fill);
  any("full").hidden = !document.fullscreenEnabled;
  any("keys").addEventListener("click", help);
  any("fold").addEventListener("click", () => {
    const open = document.body.classList.toggle("open");
    any("fold").setAttribute("aria-expanded", String(open));
  });
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target instanceof HTMLInputElement) return;
    if (event.key === " " && event.target instanceof HTMLButtonElement) return;
    if (press(view, event.key, event.shiftKey)) event.preventDefault();
  });
  prepareTilt(view);
  view.changed = () => show(view);
  show(view);
  any("controls").hidden = false;
  any("fold").hidden = false;
}
