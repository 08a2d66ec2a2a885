// Elements of the page.

/**
 * The element of this id, which is of this class.
 * @template {HTMLElement} T
 * @param {string} id @param {new () => T} kind @returns {T}
 */
export function element(id, kind) {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`#${id} is no ${kind.name}`);
  return found;
}

/** @param {string} id */
export const input = (id) => element(id, HTMLInputElement);
/** @param {string} id */
export const select = (id) => element(id, HTMLSelectElement);
/** @param {string} id */
export const canvas = (id) => element(id, HTMLCanvasElement);
/** @param {string} id */
export const any = (id) => element(id, HTMLElement);

/** @param {HTMLCanvasElement} target */
export function context(target) {
  const made = target.getContext("2d", { alpha: true });
  if (made === null) throw new Error("This browser has no canvas");
  return made;
}

/**
 * A new element with text or elements in it.
 * @param {string} tag @param {Record<string, string>} attributes @param {...(Node | string)} content
 */
export function make(tag, attributes = {}, ...content) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...content);
  return made;
}

/**
 * Shows `text`, or hides the element where there is none.
 * @param {string} id @param {string} text
 */
export function say(id, text) {
  const place = any(id);
  place.textContent = text;
  place.hidden = text === "";
}

/**
 * Puts `mark` on a place of the canvas that both lie on.
 * @param {HTMLCanvasElement} target @param {HTMLElement} mark @param {number} x @param {number} y in [0, 1)
 */
export function placeOn({ offsetLeft, offsetTop, clientWidth, clientHeight }, mark, x, y) {
  Object.assign(mark.style, { left: `${offsetLeft + x * clientWidth}px`, top: `${offsetTop + y * clientHeight}px` });
}

/**
 * "1 234 567"
 * @param {number} number
 */
export const grouped = (number) => String(number).replace(/\B(?=(\d{3})+$)/g, "\u202f");

/**
 * The value of the input, if it is a number.
 * @param {string} id
 */
export function numberIn(id) {
  const value = input(id).value.trim();
  return value === "" || !Number.isFinite(Number(value)) ? null : Number(value);
}
