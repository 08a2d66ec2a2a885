// The grid of views as a small map.
import { context } from "./dom.js";

const WIDEST = 208; // pixels
const HIGHEST = 150;

/**
 * @typedef {object} Marks
 * @property {number[]} [used] first and last row, first and last column
 * @property {{u: number, v: number}} [camera]
 * @property {{row: number, col: number}} [view]
 */

export class GridMap {
  /**
   * @param {HTMLCanvasElement} target
   * @param {any} stream
   * @param {(row: number, col: number) => void} choose called with places in the grid, not rounded
   */
  constructor(target, stream, choose) {
    this.target = target;
    this.stream = stream;
    this.step = Math.max(1, Math.min(22, WIDEST / stream.cols, HIGHEST / stream.rows));
    const ratio = devicePixelRatio || 1;
    for (const [side, count] of /** @type {const} */ ([["width", stream.cols], ["height", stream.rows]])) {
      const pixels = Math.ceil(count * this.step) + 2;
      target[side] = Math.round(pixels * ratio);
      target.style[side] = `${pixels}px`;
    }
    this.ratio = ratio;
    this.keys = new Set(stream.levels.at(-1).keys.map((/** @type {number[]} */ key) => key.join()));
    target.addEventListener("pointerdown", (event) => {
      const box = target.getBoundingClientRect();
      const place = (/** @type {number} */ at, /** @type {number} */ count) =>
        Math.max(0, Math.min(count - 1, (at - 1) / this.step - 0.5));
      choose(place(event.clientY - box.top, stream.rows), place(event.clientX - box.left, stream.cols));
    });
  }

  /** @param {Marks} marks */
  draw({ used, camera, view }) {
    const draw = context(this.target);
    const { step } = this;
    draw.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    draw.clearRect(0, 0, this.target.width, this.target.height);
    draw.translate(1, 1);
    const gap = step >= 5 ? 1 : 0;
    for (let row = 0; row < this.stream.rows; ++row) {
      for (let col = 0; col < this.stream.cols; ++col) {
        const isUsed = used && row >= used[0] && row <= used[1] && col >= used[2] && col <= used[3];
        draw.fillStyle = isUsed ? "#4f79b3" : "#2b2e35";
        draw.fillRect(col * step, row * step, step - gap, step - gap);
        if (!this.keys.has(`${row},${col}`)) continue;
        draw.strokeStyle = "#e0b45c";
        draw.lineWidth = 1.5;
        draw.strokeRect(col * step + 0.75, row * step + 0.75, step - gap - 1.5, step - gap - 1.5);
      }
    }
    if (camera) {
      draw.beginPath();
      draw.arc((camera.u + 0.5) * step - gap / 2, (camera.v + 0.5) * step - gap / 2, 4, 0, 7);
      draw.fillStyle = "#fff";
      draw.fill();
      draw.strokeStyle = "#16171a";
      draw.lineWidth = 1.5;
      draw.stroke();
    }
    if (view) {
      draw.strokeStyle = "#fff";
      draw.lineWidth = 2;
      draw.strokeRect(view.col * step, view.row * step, step - gap, step - gap);
    }
    const keys = this.keys.size === 0 ? "" : "; key images are outlined";
    this.target.setAttribute("aria-label", `Grid of ${this.stream.rows} x ${this.stream.cols} views${keys}`);
  }
}
