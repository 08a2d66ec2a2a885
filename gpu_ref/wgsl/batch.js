// Areas of blocks as submissions of hmlfc_gpu.js.

/**
 * A rectangle of blocks of one plane (0: Y, 1: Co, 2: Cg) of one view; row by row.
 * @typedef {{row: number, col: number, plane: number, bx: number, by: number, columns: number, rows: number,
 *            stopLevel?: number}} BlockArea
 */

/**
 * A rectangle of blocks of plane Y, wanted as pixels.
 * @typedef {{row: number, col: number, bx: number, by: number, columns: number, rows: number, stopLevel?: number}}
 * PixelArea
 */

/**
 * The areas, cut into whole rows where they have more than `limit` blocks, in groups of at most `limit` blocks.
 * @template {{by: number, columns: number, rows: number}} Area
 * @param {Area[]} areas @param {number} limit
 */
export function* groups(areas, limit) {
  /** @type {{area: Area, part: Area}[]} */
  let group = [];
  let room = limit;
  for (const area of areas) {
    if (!(area.columns >= 1 && area.rows >= 1)) throw new Error("an area has at least one column and row of blocks");
    const most = Math.floor(limit / area.columns);
    if (most < 1) throw new Error(`limit_exceeded: ${area.columns} blocks in a row, this device takes ${limit}`);
    for (let y = 0; y < area.rows; y += most) {
      const part = {...area, by: area.by + y, rows: Math.min(most, area.rows - y)};
      if (part.columns * part.rows > room) {
        yield group;
        group = [];
        room = limit;
      }
      group.push({area, part});
      room -= part.columns * part.rows;
    }
  }
  if (group.length) yield group;
}

/** What one submission decodes, as records of arguments.glsl. */
export class Batch {
  constructor() {
    /** @type {number[]} */
    this.areas = [];
    this.requests = 0;
    /** @type {number[]} */
    this.colourAreas = [];
    this.pixels = 0; // blocks
    this.texels = 0;
  }

  /**
   * The number of its first request.
   * @param {BlockArea} area
   */
  add(area) {
    const first = this.requests;
    const {row, col, plane, stopLevel = 0, bx, by, columns} = area;
    this.areas.push(first, row, col, plane, stopLevel, bx, by, columns, 0, 0, 0, 0);
    this.requests += columns * area.rows;
    return first;
  }

  /**
   * Blocks of Y, Co and Cg (COL-3), with `texels` pixels.
   * @param {PixelArea} area
   * @param {number} halved
   * @param {number} texels
   */
  addPixels(area, halved, texels) {
    const bx = area.bx >> halved;
    const by = area.by >> halved;
    const columns = ((area.bx + area.columns - 1) >> halved) - bx + 1;
    const rows = ((area.by + area.rows - 1) >> halved) - by + 1;
    const luma = this.add({...area, plane: 0});
    const co = this.add({...area, plane: 1, bx, by, columns, rows});
    const cg = this.add({...area, plane: 2, bx, by, columns, rows});
    this.colourAreas.push(
        this.pixels, area.columns, area.bx, area.by, luma, co, cg, bx, by, columns, this.texels, 0);
    this.pixels += area.columns * area.rows;
    this.texels += texels;
  }
}
