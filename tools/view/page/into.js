// Look into: any view at any level, its blocks and their fields.
import { askJson } from "./ask.js";
import { offerCsv } from "./block_csv.js";
import { BlockCanvas } from "./block_canvas.js";
import { addOther, showBlock } from "./block_panel.js";
import { any, canvas, element, input, numberIn, say, select } from "./dom.js";
import { prepareFind } from "./find.js";
import { GridMap } from "./grid_map.js";
import { overlayOf, showLegend, STATES } from "./overlays.js";
import { PlanePictures } from "./plane_pictures.js";
import { prepareSplitBar } from "./split_bar.js";
import { sampleAt } from "./stage_picture.js";
import { showTotals } from "./totals.js";

/** @typedef {import("./ask.js").Query} Query */

/** @typedef {ReturnType<Into["firstPlace"]>} Place */

const LISTS = /** @type {const} */ (["plane", "stage", "beside", "overlay"]);
const CHECKS = /** @type {const} */ (["blocks", "tiles", "vectors"]);

export class Into {
  /** @param {any} stream @param {(query: Query) => void} moved */
  constructor(stream, moved) {
    this.stream = stream;
    this.moved = moved;
    this.all = stream.tree_height + 1;
    this.place = this.firstPlace();
    this.map = new GridMap(canvas("into-map"), stream, (row, col) => this.change({ row: Math.round(row), col: Math.round(col) }));
    this.canvas = new BlockCanvas(canvas("picture"), (x, y) => this.hover(x, y), (x, y) => this.pin(x, y));
    // The picture beside it may have half as many samples.
    /** @type {(at: number) => number} */
    const across = (at) => Math.floor((at * (this.canvas.layers?.picture.width ?? 0)) / (this.beside.layers?.picture.width ?? 1));
    /** @type {BlockCanvas} */
    this.beside = new BlockCanvas(canvas("picture-beside"), (x, y) => this.hover(across(x), across(y)), (x, y) => this.pin(across(x), across(y)));
    this.pictures = new PlanePictures(stream.depth);
    this.blocks = null;
    /** @type {Int16Array | null} */
    this.samples = null;
    this.number = 0; // of the change that is shown
    this.note = ""; // about the link that was opened
    this.prepareControls();
  }

  firstPlace() {
    const block = /** @type {[number, number] | null} column, row */ (null);
    return {
      row: Math.floor((this.stream.rows - 1) / 2), col: Math.floor((this.stream.cols - 1) / 2), plane: "Y",
      levels: this.all, stage: "picture", beside: "none", overlay: "none", blocks: false, tiles: false, vectors: false, block,
    };
  }

  prepareControls() {
    input("view-row").max = String(this.stream.rows - 1);
    input("view-col").max = String(this.stream.cols - 1);
    input("into-levels").max = String(this.all);
    any("into-levels-label").hidden = this.all === 1;
    for (const list of [select("stage"), select("overlay")]) {
      for (const option of [...list.options]) {
        if (["original", "difference", "psnr"].includes(option.value) && !this.stream.original) option.remove();
        if (option.value.startsWith("dut") && !this.stream.dut) option.remove();
        option.text = option.text.replace("the decoder under test", this.stream.dut);
      }
    }
    for (const option of select("stage").options) select("beside").add(new Option(option.text, option.value));
    if (this.stream.twin) select("beside").add(new Option(`the same of ${this.stream.twin.name}`, "twin"));
    const last = { row: this.stream.rows - 1, col: this.stream.cols - 1 };
    for (const side of /** @type {const} */ (["row", "col"])) {
      input(`view-${side}`).addEventListener("change", () => {
        const value = Math.round(numberIn(`view-${side}`) ?? this.place[side]);
        this.change({ [side]: Math.max(0, Math.min(last[side], value)) });
      });
    }
    for (const name of LISTS) {
      select(name).addEventListener("change", () => this.change({ [name]: select(name).value, ...(name === "plane" ? { block: null } : {}) }));
    }
    input("into-levels").addEventListener("input", () => this.change({ levels: Number(input("into-levels").value) }));
    input("blend").addEventListener("input", () => void this.show());
    for (const name of CHECKS) {
      input(`show-${name}`).addEventListener("change", () => this.change({ [name]: input(`show-${name}`).checked }));
    }
    for (const name of ["picture", "picture-beside"]) {
      canvas(name).addEventListener("keydown", (event) => {
        if (this.press(event.key)) event.preventDefault();
      });
    }
    any("totals").addEventListener("toggle", () => void showTotals(), { once: true });
    any("save-csv").addEventListener("click", (event) => this.blocks ? offerCsv(element("save-csv", HTMLAnchorElement), this.blocks) : event.preventDefault());
    prepareFind((words) => this.stepToError(1, words));
    prepareSplitBar("split");
  }

  /** @param {string} key */
  press(key) {
    /** @type {Record<string, [number, number]>} */
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (key === "+" || key === "=") this.canvas.zoom(1.25);
    else if (key === "-") this.canvas.zoom(0.8);
    else if (key === ",") this.step(-1);
    else if (key === ".") this.step(1);
    else if (key === "n" || key === "p") this.stepToError(key === "n" ? 1 : -1) || say("into-error", "This plane has no block with an error.");
    else if (key in arrows && this.blocks) {
      const [x, y] = this.place.block ?? [0, 0];
      const [right, down] = arrows[key];
      const column = Math.max(0, Math.min(this.blocks.columns - 1, x + right));
      this.change({ block: [column, Math.max(0, Math.min(this.blocks.rows - 1, y + down))] });
    } else return false;
    return true;
  }

  /**
   * To the next view, row by row, or to the one before.
   * @param {1 | -1} by
   */
  step(by) {
    const { rows, cols } = this.stream;
    const view = (this.place.row * cols + this.place.col + by + rows * cols) % (rows * cols);
    this.change({ row: Math.floor(view / cols), col: view % cols });
  }

  /**
   * To the next block with an error that has these words in this plane, or to the one before; false where there is none.
   * @param {1 | -1} by @param {string} words
   */
  stepToError(by, words = "") {
    const { columns, errors } = this.blocks ?? { columns: 1, errors: [] };
    const numbers = errors.filter((/** @type {[number, string]} */ [, text]) => text.includes(words))
      .map((/** @type {[number, string]} */ [number]) => number).sort((/** @type {number} */ a, /** @type {number} */ b) => by * (a - b));
    if (numbers.length === 0) return false;
    const [x, y] = this.place.block ?? [-1, 0];
    const next = numbers.find((/** @type {number} */ number) => by * (number - (y * columns + x)) > 0) ?? numbers[0];
    this.change({ block: [next % columns, Math.floor(next / columns)] });
    return true;
  }

  /** @param {Partial<Place>} changes */
  change(changes) {
    this.note = "";
    Object.assign(this.place, changes);
    void this.show();
  }

  /** @param {URLSearchParams} link */
  open(link) {
    const place = this.firstPlace();
    const pair = (/** @type {string} */ name, /** @type {number} */ endX, /** @type {number} */ endY) => {
      const [x, y] = (link.get(name) ?? "").split(",").map(Number);
      const good = link.has(name) && Number.isInteger(x) && Number.isInteger(y) && x >= 0 && x < endX && y >= 0 && y < endY;
      return good ? /** @type {[number, number]} */ ([x, y]) : null;
    };
    [place.row, place.col] = pair("view", this.stream.rows, this.stream.cols) ?? [place.row, place.col];
    place.block = pair("block", 65536, 65536);
    const levels = Number(link.get("levels"));
    if (Number.isInteger(levels) && levels >= 1 && levels <= this.all) place.levels = levels;
    for (const name of LISTS) {
      place[name] = [...select(name).options].find(({ value }) => value === link.get(name))?.value ?? place[name];
    }
    for (const name of CHECKS) place[name] = (link.get("show") ?? "").split(",").includes(name);
    this.place = place;
    const wrong = Object.entries({ ...place, view: `${place.row},${place.col}` })
      .flatMap(([name, value]) => ((link.get(name) ?? `${value}`) === `${value}` ? [] : [`${name} ${link.get(name)}`]));
    this.note = wrong.length > 0 ? `This stream has no ${wrong.join(", no ")}.` : "";
    void this.show();
  }

  /** @returns {Query} with no more levels than `stream` has */
  view(stream = this.stream) {
    const query = { view: `${this.place.row},${this.place.col}` };
    const all = this.place.levels === this.all || this.place.levels > stream.tree_height;
    return all ? query : { ...query, levels: this.place.levels };
  }

  /** @returns {Query} */
  link() {
    const { plane, stage, beside, overlay, block } = this.place;
    const shown = CHECKS.filter((name) => this.place[name]).join(",");
    return {
      ...this.view(), plane, stage, ...(beside === "none" ? {} : { beside }), overlay, ...(shown ? { show: shown } : {}), ...(block ? { block: block.join(",") } : {}),
    };
  }

  /** Asks for what is missing and draws it, unless there is a newer change by then. */
  async show() {
    const number = ++this.number;
    this.showControls();
    const place = { ...this.place };
    const view = this.view();
    const plane = { ...view, plane: place.plane };
    try {
      const { pictures } = this;
      const told = await pictures.once("blocks", plane, (query) => askJson("blocks", query));
      const blocks = place.overlay === "dut"
        ? { ...told, ...await pictures.once("dut-blocks", plane, (query) => askJson("dut-blocks", query)) } : told;
      const rgb = await pictures.rgb("picture", view).catch(() => null);
      const stage = rgb === null && place.stage === "picture" ? "sample" : place.stage;
      const shown = await pictures.stage(stage, plane, blocks);
      const twinPlane = { ...this.view(this.stream.twin), plane: place.plane };
      const twin = place.beside === "twin" ? await pictures.once("twin-blocks", twinPlane, (query) => askJson("twin-blocks", query)) : null;
      const second = twin ? `twin-${/original|difference|dut/.test(stage) ? "picture" : stage}` : place.beside;
      const beside = second === "none" ? null : await pictures.stage(second, twin ? twinPlane : plane, twin ?? blocks);
      const block = place.block && place.block[0] < blocks.columns && place.block[1] < blocks.rows ? place.block : null;
      const query = { ...plane, block: block?.join(",") ?? "" };
      const answer = block && (await pictures.once("block", query, (asked) => askJson("block", asked)));
      const pixels = (/** @type {any} */ stream, /** @type {any} */ { width }) => stream.block * Math.round(stream.width / width);
      const [side, twinSide] = twin ? [pixels(this.stream, blocks), pixels(this.stream.twin, twin)] : [1, 1];
      const there = block && twin && block.map((at) => Math.floor((at * side) / twinSide));
      const other = there && (await pictures.once("twin-block", { ...twinPlane, block: there.join(",") }, (asked) => askJson("twin-block", asked)));
      if (number !== this.number) return;
      this.blocks = blocks;
      this.samples = shown.samples;
      this.draw(shown, beside, rgb, blocks, block, twin, there);
      showBlock(answer, (row, col) => this.change({ row, col }), other, [this.stream, this.stream.twin].map((one) => one?.file), side === twinSide);
      say("into-error", place.block && !block ? `Not in plane ${place.plane}: block ${place.block}.` : this.note);
      if (answer && this.stream.dut) await this.showOther(number, query, answer);
    } catch (error) {
      if (number === this.number) say("into-error", /** @type {Error} */ (error).message);
    }
  }

  /**
   * Adds the block by the decoder under test, which may take long, to the panel.
   * @param {number} number of the change @param {Query} query @param {any} answer the block
   */
  async showOther(number, query, answer) {
    const other = await this.pictures.once("dut-block", query, (asked) => askJson("dut-block", asked))
      .catch((error) => ({ name: this.stream.dut, error: error.message, stages: [], pixels: null }));
    if (number === this.number) addOther(other, answer);
  }

  /**
   * @param {import("./plane_pictures.js").Picture} shown @param {import("./plane_pictures.js").Picture | null} beside
   * @param {HTMLCanvasElement | null} rgb
   * @param {any} own the blocks @param {[number, number] | null} block
   * @param {any} twin the blocks beside them, or null @param {number[] | null} there its block
   */
  draw(shown, beside, rgb, own, block, twin, there) {
    const overlay = overlayOf(this.place.overlay, own);
    const second = twin ? overlayOf(this.place.overlay, twin, overlay) : overlay;
    showLegend(overlay, second);
    /** @returns {import("./block_canvas.js").Layers} */
    const layers = (/** @type {import("./plane_pictures.js").Picture} */ { shown: picture, samples }, blocks = own, pin = /** @type {number[] | null} */ (block), size = this.stream.block, { colours } = overlay) => ({
      // A plane of chroma may have half the samples of the picture.
      picture, value: samples && ((/** @type {number} */ x, /** @type {number} */ y) => String(sampleAt(samples, y * blocks.width + x) ?? "")),
      under: rgb, blend: Number(input("blend").value) / 100, blocks,
      side: size * (picture.width > blocks.width ? 2 : 1), colours,
      showBlocks: this.place.blocks, showTiles: this.place.tiles, showVectors: this.place.vectors,
      pinned: pin === null ? null : pin[1] * blocks.columns + pin[0],
    });
    const stage = /** @type {HTMLElement} */ (this.canvas.target.parentElement);
    stage.classList.toggle("two", beside !== null);
    this.beside.target.hidden = beside === null;
    [this.canvas.twin, this.beside.twin] = beside === null ? [null, null] : [this.beside, this.canvas];
    if (beside !== null) this.beside.layers = twin ? layers(beside, twin, there, this.stream.twin.block, second) : layers(beside);
    this.canvas.show(layers(shown));
    this.beside.draw();
    canvas("picture").dataset.shown = JSON.stringify(this.link());
    this.moved(this.link());
  }

  /**
   * The block at a sample of the picture, or null.
   * @param {number} x @param {number} y @returns {[number, number] | null}
   */
  blockAt(x, y) {
    const { layers } = this.canvas;
    if (!layers || x < 0 || y < 0 || x >= layers.picture.width || y >= layers.picture.height) return null;
    return [Math.floor(x / layers.side), Math.floor(y / layers.side)];
  }

  /** @param {number} x @param {number} y */
  pin(x, y) {
    this.change({ block: this.blockAt(x, y) });
  }

  /** @param {number} x @param {number} y */
  hover(x, y) {
    const block = this.blockAt(x, y);
    any("hover").textContent = block === null ? "" : this.describe(block, x, y);
  }

  /** @param {[number, number]} block @param {number} x @param {number} y */
  describe(block, x, y) {
    const { blocks, stream } = this;
    const layers = /** @type {import("./block_canvas.js").Layers} */ (this.canvas.layers);
    const unit = layers.side / stream.block;
    const [sampleX, sampleY] = [Math.floor(x / unit), Math.floor(y / unit)];
    const at = block[1] * blocks.columns + block[0];
    const error = blocks.errors.find((/** @type {[number, string]} */ [number]) => number === at);
    const parts = [`block x ${block[0]}, y ${block[1]}`, `sample x ${sampleX}, y ${sampleY}`];
    const value = this.samples && sampleAt(this.samples, sampleY * blocks.width + sampleX);
    if (this.samples) parts.push(`${this.place.stage} ${value ?? "none"}`);
    parts.push(error ? error[1] : STATES[blocks.states[at]]);
    if (blocks.states[at] < 4) parts.push(`${blocks.bits[at]} bits, ${blocks.read[at]} read`);
    if (blocks.level_counts[at] > 0) parts.push(`${blocks.level_counts[at]} levels`);
    if (blocks.steps[at] > 0) parts.push(`step ${blocks.steps[at]}`);
    for (const [number, row, col, dx, dy] of blocks.vectors) {
      if (number === at) parts.push(`(${dx}, ${dy}) to image row ${row}, column ${col}`);
    }
    if (blocks.disparities?.[at] != null) parts.push(`disparity ${blocks.disparities[at]}`);
    if (blocks.worst?.[at] > 0) parts.push(`${this.stream.dut} differs by up to ${blocks.worst[at]}`);
    if (blocks.psnr) parts.push(blocks.psnr[at] === null ? "equal to the original" : `${blocks.psnr[at]} dB`);
    return parts.join(" · ");
  }

  showControls() {
    const { place } = this;
    input("view-row").value = String(place.row);
    input("view-col").value = String(place.col);
    input("into-levels").value = String(place.levels);
    any("into-levels-value").textContent = `${place.levels} of ${this.all}`;
    any("blend-value").textContent = `${input("blend").value} %`;
    any("blend-label").hidden = place.stage === "picture";
    for (const name of LISTS) select(name).value = place[name];
    for (const name of CHECKS) input(`show-${name}`).checked = place[name];
    this.map.draw({ view: { row: place.row, col: place.col } });
    const query = { ...this.view(), plane: place.plane, block: (place.block ?? [0, 0]).join(",") };
    const options = Object.entries(query).map(([name, value]) => `--${name} ${value}`);
    any("into-command").textContent = `hmlfc inspect ${this.stream.file} ${options.join(" ")}`;
  }
}
