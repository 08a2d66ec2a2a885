// A picture of blocks that is dragged and zoomed, with overlays on it.
import { context } from "./dom.js";

const MOST = 64; // pixels of the screen for a sample
const WRITTEN = 24; // pixels of the screen for a sample, from which its value stands in it
const DRAWN = 9; // pixels of the screen for a block, from which lines between blocks and heads of arrows are drawn

/**
 * @typedef {object} Layers
 * @property {HTMLCanvasElement} picture
 * @property {HTMLCanvasElement | null} under the picture to blend with
 * @property {number} blend part of `under`, [0, 1]
 * @property {any} blocks what the server says of the plane, or null
 * @property {((x: number, y: number) => string) | null} value of a sample of the plane
 * @property {number} side samples of a block in the picture
 * @property {(string | null)[]} colours of blocks
 * @property {boolean} showBlocks
 * @property {boolean} showTiles
 * @property {boolean} showVectors
 * @property {number | null} pinned a block
 */

export class BlockCanvas {
  /**
   * @param {HTMLCanvasElement} target
   * @param {(x: number, y: number) => void} hover @param {(x: number, y: number) => void} click samples
   */
  constructor(target, hover, click) {
    this.target = target;
    /** @type {Layers | null} */
    this.layers = null;
    this.scale = 0; // pixels of the screen for a sample; 0: not placed yet
    this.x = 0; // of the picture's left edge on the screen
    this.y = 0;
    /** @type {BlockCanvas | null} */
    this.twin = null; // shows the same blocks beside it
    this.listen(hover, click);
    new ResizeObserver(() => this.draw()).observe(target);
  }

  /** @param {Layers} layers */
  show(layers) {
    const before = this.layers?.picture;
    if (this.scale > 0 && before && before.width !== layers.picture.width) this.scale = 0;
    this.layers = layers;
    this.draw();
  }

  fit() {
    const { picture } = /** @type {Layers} */ (this.layers);
    const { clientWidth, clientHeight } = this.target;
    const scale = Math.min(clientWidth / picture.width, clientHeight / picture.height);
    this.scale = scale > 1 ? Math.floor(scale * 4) / 4 : scale;
    this.x = (clientWidth - picture.width * this.scale) / 2;
    this.y = (clientHeight - picture.height * this.scale) / 2;
  }

  /**
   * Zooms by a factor around a place on the screen.
   * @param {number} factor @param {number} x @param {number} y
   */
  zoom(factor, x = this.target.clientWidth / 2, y = this.target.clientHeight / 2) {
    const scale = Math.max(0.1, Math.min(MOST, this.scale * factor));
    this.x = x - ((x - this.x) * scale) / this.scale;
    this.y = y - ((y - this.y) * scale) / this.scale;
    this.scale = scale;
    this.draw();
  }

  /**
   * @param {(x: number, y: number) => void} hover @param {(x: number, y: number) => void} click
   */
  listen(hover, click) {
    const { target } = this;
    /** @type {{x: number, y: number, far: number} | null} */
    let held = null;
    const sample = (/** @type {PointerEvent} */ event) => {
      const box = target.getBoundingClientRect();
      return /** @type {[number, number]} */ ([
        Math.floor((event.clientX - box.left - this.x) / this.scale),
        Math.floor((event.clientY - box.top - this.y) / this.scale)]);
    };
    target.addEventListener("pointerdown", (event) => {
      target.setPointerCapture(event.pointerId);
      held = { x: event.clientX, y: event.clientY, far: 0 };
    });
    target.addEventListener("pointermove", (event) => {
      if (held === null) {
        hover(...sample(event));
        return;
      }
      const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
      held = { x: event.clientX, y: event.clientY, far: held.far + Math.hypot(dx, dy) };
      if (held.far <= 4) return;
      this.x += dx;
      this.y += dy;
      this.draw();
    });
    target.addEventListener("pointerup", (event) => {
      if (held !== null && held.far <= 4) click(...sample(event));
      held = null;
    });
    target.addEventListener("pointercancel", () => (held = null));
    target.addEventListener("wheel", (event) => {
      event.preventDefault();
      const box = target.getBoundingClientRect();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY : event.deltaY / 40;
      this.zoom(1.15 ** Math.max(-5, Math.min(5, -lines)), event.clientX - box.left, event.clientY - box.top);
    }, { passive: false });
  }

  draw() {
    if (this.layers === null || this.target.clientWidth === 0) return;
    if (this.scale === 0) this.fit();
    const ratio = devicePixelRatio || 1;
    this.target.width = Math.round(this.target.clientWidth * ratio);
    this.target.height = Math.round(this.target.clientHeight * ratio);
    const draw = context(this.target);
    draw.imageSmoothingEnabled = false;
    draw.setTransform(ratio * this.scale, 0, 0, ratio * this.scale, ratio * this.x, ratio * this.y);
    const { picture, under, blend, colours } = this.layers;
    // Colours of an overlay mean something: they lie over grey.
    if (colours.some((colour) => colour !== null)) draw.filter = "grayscale(1)";
    draw.drawImage(picture, 0, 0);
    if (under && blend > 0) {
      draw.globalAlpha = blend;
      draw.drawImage(under, 0, 0, picture.width, picture.height);
      draw.globalAlpha = 1;
    }
    draw.filter = "none";
    if (this.layers.blocks) this.drawBlocks(draw, this.layers);
    if (this.layers.blocks && this.layers.value) this.write(draw, this.layers, this.layers.value);
    Object.assign(this.target.dataset, { scale: this.scale, x: this.x, y: this.y });
    this.twin?.follow(this);
  }

  /**
   * Shows the part that `other` shows, whose picture may have another number of samples.
   * @param {BlockCanvas} other
   */
  follow(other) {
    if (this.layers === null || other.layers === null) return;
    const scale = (other.scale * other.layers.picture.width) / this.layers.picture.width;
    if (this.scale === scale && this.x === other.x && this.y === other.y) return;
    Object.assign(this, { scale, x: other.x, y: other.y });
    this.draw();
  }

  /**
   * @param {CanvasRenderingContext2D} draw @param {Layers} layers
   */
  drawBlocks(draw, layers) {
    const { blocks, side, colours } = layers;
    const [left, top] = [-this.x, -this.y].map((at) => Math.max(0, Math.floor(at / this.scale / side)));
    const right = Math.min(blocks.columns, Math.ceil((this.target.clientWidth - this.x) / this.scale / side));
    const bottom = Math.min(blocks.rows, Math.ceil((this.target.clientHeight - this.y) / this.scale / side));
    for (let y = top; y < bottom; ++y) {
      for (let x = left; x < right; ++x) {
        const at = y * blocks.columns + x;
        if (colours[at]) {
          draw.globalAlpha = 0.62;
          draw.fillStyle = /** @type {string} */ (colours[at]);
          draw.fillRect(x * side, y * side, side, side);
          draw.globalAlpha = 1;
        }
        if (blocks.states[at] === 5) this.cross(draw, x * side, y * side, side);
      }
    }
    const pixel = 1 / this.scale;
    if (layers.showBlocks && side * this.scale >= DRAWN) this.lines(draw, layers, side, "#ffffff50", pixel);
    if (layers.showTiles) this.lines(draw, layers, 8 * side, "#ffffffb0", pixel);
    if (layers.showVectors) this.vectors(draw, layers);
    if (layers.pinned === null) return;
    const [x, y] = [layers.pinned % blocks.columns, Math.floor(layers.pinned / blocks.columns)];
    for (const [colour, width] of /** @type {const} */ ([["#000", 4], ["#fff", 2]])) {
      draw.strokeStyle = colour;
      draw.lineWidth = width * pixel;
      draw.strokeRect(x * side, y * side, side, side);
    }
  }

  /**
   * The value of each sample in it, where there is room.
   * @param {CanvasRenderingContext2D} draw @param {Layers} layers @param {(x: number, y: number) => string} value
   */
  write(draw, { picture, blocks }, value) {
    const unit = picture.width / blocks.width;
    const side = unit * this.scale;
    if (side < WRITTEN) return;
    const ends = (/** @type {number} */ at, /** @type {number} */ room, /** @type {number} */ count) =>
      [Math.max(0, Math.floor(-at / side)), Math.min(count, Math.ceil((room - at) / side))];
    const [left, right] = ends(this.x, this.target.clientWidth, blocks.width);
    const [top, bottom] = ends(this.y, this.target.clientHeight, blocks.height);
    Object.assign(draw, { font: `${unit * 0.38}px ui-monospace, monospace`, textAlign: "center", textBaseline: "middle" });
    Object.assign(draw, { fillStyle: "#fff", strokeStyle: "#000c", lineWidth: unit * 0.1, lineJoin: "round" });
    for (let y = top; y < bottom; ++y) {
      for (let x = left; x < right; ++x) {
        const text = value(x, y);
        draw.strokeText(text, (x + 0.5) * unit, (y + 0.5) * unit, unit * 0.9);
        draw.fillText(text, (x + 0.5) * unit, (y + 0.5) * unit, unit * 0.9);
      }
    }
  }

  /**
   * An error block.
   * @param {CanvasRenderingContext2D} draw @param {number} x @param {number} y @param {number} side
   */
  cross(draw, x, y, side) {
    draw.fillStyle = "#5a0f0b";
    draw.fillRect(x, y, side, side);
    draw.strokeStyle = "#ff3b30";
    draw.lineWidth = side / 10;
    draw.beginPath();
    draw.moveTo(x, y);
    draw.lineTo(x + side, y + side);
    draw.moveTo(x + side, y);
    draw.lineTo(x, y + side);
    draw.stroke();
  }

  /**
   * @param {CanvasRenderingContext2D} draw @param {Layers} layers @param {number} step
   * @param {string} colour @param {number} pixel
   */
  lines(draw, { picture }, step, colour, pixel) {
    draw.strokeStyle = colour;
    draw.lineWidth = pixel;
    draw.beginPath();
    for (let x = 0; x <= picture.width; x += step) {
      draw.moveTo(x, 0);
      draw.lineTo(x, picture.height);
    }
    for (let y = 0; y <= picture.height; y += step) {
      draw.moveTo(0, y);
      draw.lineTo(picture.width, y);
    }
    draw.stroke();
  }

  /**
   * From the middle of each block to where its vector points.
   * @param {CanvasRenderingContext2D} draw @param {Layers} layers
   */
  vectors(draw, { blocks, side, picture }) {
    const unit = picture.width / blocks.width; // of the plane's samples in the picture
    draw.lineWidth = 1 / this.scale;
    const heads = side * this.scale >= DRAWN;
    draw.strokeStyle = heads ? "#7dffb0" : "#7dffb0a0";
    draw.beginPath();
    for (const [block, , , dx, dy] of blocks.vectors) {
      const x = ((block % blocks.columns) + 0.5) * side;
      const y = (Math.floor(block / blocks.columns) + 0.5) * side;
      const [toX, toY] = [x + dx * unit, y + dy * unit];
      draw.moveTo(x, y);
      draw.lineTo(toX, toY);
      const length = Math.hypot(toX - x, toY - y);
      if (!heads || length * this.scale < 4) continue;
      const head = Math.min(length, 5 / this.scale) / length;
      const [backX, backY] = [(x - toX) * head, (y - toY) * head];
      draw.moveTo(toX + backX - backY / 2, toY + backY + backX / 2);
      draw.lineTo(toX, toY);
      draw.lineTo(toX + backX + backY / 2, toY + backY - backX / 2);
    }
    draw.stroke();
  }
}
