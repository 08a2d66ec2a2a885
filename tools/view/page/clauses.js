// Clauses of the specification and of docs/rendering.md, which the program has in it.
import { askText } from "./ask.js";
import { any, element, make } from "./dom.js";

/** @type {Promise<string[]> | null} */
let documents = null;

/**
 * The paragraphs of a clause, from its name to the next clause or heading.
 * @param {string} text @param {string} clause
 */
export function clauseText(text, clause) {
  const begin = text.indexOf(`**[${clause}]**`);
  if (begin < 0) return `There is no clause ${clause}`;
  const rest = text.slice(begin + 2);
  const end = rest.search(/\n(\*\*\[|#)/);
  return (end < 0 ? rest : rest.slice(0, end)).replaceAll("**", "").trim();
}

/** @param {string} clause */
async function showClause(clause) {
  documents ??= Promise.all(["specification.md", "rendering.md"].map(askText));
  any("clause-text").textContent = clauseText((await documents).join("\n"), clause);
  element("clause", HTMLDialogElement).showModal();
}

/** @param {string} clause */
export function clauseButton(clause) {
  const button = make("button", { type: "button", title: `Show ${clause}` }, clause);
  button.addEventListener("click", () => void showClause(clause));
  return button;
}
