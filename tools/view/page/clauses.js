// Clauses of the specification, which the program has in it.
import { askText } from "./ask.js";
import { any, element } from "./dom.js";

/** @type {Promise<string> | null} */
let specification = null;

/**
 * The paragraphs of a clause, from its name to the next clause or heading.
 * @param {string} text @param {string} clause
 */
export function clauseText(text, clause) {
  const begin = text.indexOf(`**[${clause}]**`);
  if (begin < 0) return `The specification has no clause ${clause}`;
  const rest = text.slice(begin + 2);
  const end = rest.search(/\n(\*\*\[|#)/);
  return (end < 0 ? rest : rest.slice(0, end)).replaceAll("**", "").trim();
}

/** @param {string} clause */
export async function showClause(clause) {
  specification ??= askText("specification.md");
  any("clause-text").textContent = clauseText(await specification, clause);
  element("clause", HTMLDialogElement).showModal();
}
