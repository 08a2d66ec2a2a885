// The bar between the picture and what is below it, which is dragged, or moved by arrow keys.
import { any } from "./dom.js";

const LEAST = 18; // per cent of the window that the picture has
const GREATEST = 88;
const STEP = 4;

/** @param {string} id of the bar, the sibling of the picture's section */
export function prepareSplitBar(id) {
  const bar = any(id);
  const main = /** @type {HTMLElement} */ (bar.parentElement);
  let part = Number(bar.getAttribute("aria-valuenow"));
  const move = (/** @type {number} */ to) => {
    part = Math.max(LEAST, Math.min(GREATEST, to));
    main.style.setProperty("--picture", `${part}vh`);
    bar.setAttribute("aria-valuenow", part.toFixed(0));
  };
  bar.addEventListener("pointerdown", (event) => bar.setPointerCapture(event.pointerId));
  bar.addEventListener("pointermove", (event) => {
    if (bar.hasPointerCapture(event.pointerId)) move(part + (100 * event.movementY) / innerHeight);
  });
  bar.addEventListener("keydown", (event) => {
    const by = { ArrowUp: -STEP, ArrowDown: STEP }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    move(part + by);
  });
}
