// How a pixel of the frame comes about, as `hmlfc render --trace` has it.
import { askJson } from "./ask.js";
import { linkTo } from "./camera.js";
import { clauseButton } from "./clauses.js";
import { any, canvas, input, make, numberIn, placeOn, say } from "./dom.js";

/** @typedef {import("./ask.js").Query} Query */

/**
 * A link to the block of plane Y that the stage takes from its view.
 * @param {any} stage of a view @param {any} stream @param {Query} frame
 */
function viewLink(stage, stream, frame) {
  const last = (/** @type {string} */ name) =>
    stage.values.filter((/** @type {any} */ value) => value.name === name).at(-1)?.value;
  const side = (/** @type {number} */ whole, /** @type {number} */ displaced, /** @type {number} */ size) => {
    const pixel = whole ?? Math.floor((displaced + 2048) / 4096); // SRF-3
    return Math.floor(Math.max(0, Math.min(size - 1, pixel)) / stream.block);
  };
  const block = [side(last("xi"), last("x(c, E)"), stream.width), side(last("yi"), last("y(r, E)"), stream.height)];
  const view = `${stage.view.row},${stage.view.col}`;
  const place = { view, ...("levels" in frame ? { levels: frame.levels } : {}), plane: "Y", block: block.join(",") };
  return make("a", { href: linkTo({ mode: "into", ...place }), title: `Look into view ${view}, block ${place.block}` }, view);
}

/**
 * @param {any} stage @param {any} stream @param {Query} frame
 */
function stageTable(stage, stream, frame) {
  let shown = "";
  const rows = stage.values.map((/** @type {any} */ { name, value, clause }) => {
    const place = make("td", {}, ...(clause === shown ? [] : [clauseButton(clause)]));
    shown = clause;
    return make("tr", {}, place, make("td", {}, name), make("td", {}, String(value)));
  });
  const title = stage.view ? [`${stage.stage} `, viewLink(stage, stream, frame)] : [stage.stage];
  return make("table", { class: "fields" }, make("caption", {}, ...title), make("tbody", {}, ...rows));
}

export class PixelPanel {
  /**
   * @param {any} stream @param {[number, number]} size of a frame @param {() => Query} frame the whole frame that is
   * wanted @param {() => void} chosen told of another pixel, and when the panel opens and closes
   */
  constructor(stream, size, frame, chosen) {
    this.stream = stream;
    this.size = size;
    this.frame = frame;
    this.chosen = chosen;
    this.pixel = size.map((side) => Math.floor(side / 2));
    this.open = false;
    this.number = 0; // of the question whose answer is shown
    for (const name of ["how", "pixel-close"]) any(name).addEventListener("click", () => this.toggle());
    for (const [at, name] of ["pixel-x", "pixel-y"].entries()) {
      input(name).max = String(size[at] - 1);
      input(name).addEventListener("change", () => this.choose(numberIn("pixel-x"), numberIn("pixel-y")));
    }
  }

  toggle() {
    this.show(!this.open);
    if (this.open) this.ask();
    this.chosen();
  }

  /**
   * Opens the panel at a pixel; null leaves a side as it is.
   * @param {number | null} x @param {number | null} y
   */
  choose(x, y) {
    this.pixel = [x, y].map((side, at) => Math.max(0, Math.min(this.size[at] - 1, Math.floor(side ?? this.pixel[at]))));
    this.show(true);
    this.ask();
    this.chosen();
  }

  /**
   * What a link says of the pixel; the frame that follows asks for it.
   * @param {URLSearchParams} link
   */
  read(link) {
    const pixel = (link.get("trace") ?? "").split(",").map(Number);
    const good = pixel.length === 2 && pixel.every((side, at) => Number.isInteger(side) && side >= 0 && side < this.size[at]);
    if (link.has("trace") && good) this.pixel = pixel;
    this.show(link.has("trace"));
  }

  /** @returns {Query} */
  link() {
    return this.open ? { trace: this.pixel.join(",") } : {};
  }

  /** @param {boolean} open */
  show(open) {
    if (open && !this.open) canvas("frame").scrollIntoView({ block: "nearest" });
    this.open = open;
    any("pixel").hidden = any("pixel-mark").hidden = !open;
    any("look").classList.toggle("traced", open);
    any("how").setAttribute("aria-pressed", String(open));
    [input("pixel-x").value, input("pixel-y").value] = this.pixel.map(String);
    this.mark();
  }

  /** Puts the mark on the pixel. */
  mark() {
    const [x, y] = this.pixel.map((side, at) => (side + 0.5) / this.size[at]);
    placeOn(canvas("frame"), any("pixel-mark"), x, y);
  }

  /** Asks how the pixel of the frame comes about and shows it, unless there is a newer question by then. */
  async ask() {
    const number = ++this.number;
    const frame = this.frame();
    const trace = this.pixel.join(",");
    try {
      const answer = await askJson("trace", { ...frame, trace });
      if (number !== this.number) return;
      const [record, ...stages] = answer.stages.map((/** @type {any} */ stage) => stageTable(stage, this.stream, frame));
      any("pixel-stages").replaceChildren(
        make("p", {}, `Pixel ${trace}: ${["R", "G", "B"].map((name, at) => `${name} ${answer.sample[at]}`).join(", ")}`),
        make("details", {}, make("summary", {}, "The frame's record"), record),
        make("div", { class: "matrices" }, ...stages));
      const levels = "levels" in frame ? ` --levels ${frame.levels}` : "";
      any("pixel-command").textContent = `hmlfc render ${this.stream.file} --inputs ${answer.inputs}${levels} --trace ${trace}`;
      say("pixel-error", "");
    } catch (error) {
      if (number !== this.number) return;
      any("pixel-stages").replaceChildren();
      any("pixel-command").textContent = "";
      say("pixel-error", /** @type {Error} */ (error).message);
    }
  }
}
