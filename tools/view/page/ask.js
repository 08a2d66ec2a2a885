// Questions to the server, each at an address beside the page's own.

/** @typedef {Record<string, string | number>} Query */

/** @param {string} path @param {Query} query */
export function address(path, query = {}) {
  const pairs = Object.entries(query).map(
    ([name, value]) => `${name}=${encodeURIComponent(value).replaceAll("%2C", ",")}`);
  return pairs.length === 0 ? path : `${path}?${pairs.join("&")}`;
}

/**
 * The answer, or an Error with the text that the server gives.
 * @param {string} path @param {Query} query
 */
async function ask(path, query) {
  let answer;
  try {
    answer = await fetch(address(path, query));
  } catch {
    throw new Error("hmlfc view has ended; start it again");
  }
  if (answer.ok) return answer;
  const body = await answer.json().catch(() => ({}));
  throw new Error(body.error ?? `The server answers with status ${answer.status}`);
}

/** @param {string} path @param {Query} query @returns {Promise<any>} */
export async function askJson(path, query = {}) {
  return (await ask(path, query)).json();
}

/** @param {string} path @returns {Promise<string>} */
export async function askText(path) {
  return (await ask(path, {})).text();
}

/**
 * Pixels, and what the header Frame says of them.
 * @param {string} path @param {Query} query
 */
export async function askPicture(path, query) {
  const answer = await ask(path, query);
  const [width, height] = (answer.headers.get("Picture-Size") ?? "").split(",").map(Number);
  const pixels = new ImageData(new Uint8ClampedArray(await answer.arrayBuffer()), width, height);
  return { pixels, cost: JSON.parse(answer.headers.get("Frame") ?? "null") };
}

/**
 * Samples of a stage.
 * @param {string} path @param {Query} query
 */
export async function askSamples(path, query) {
  return new Int16Array(await (await ask(path, query)).arrayBuffer());
}

/**
 * Tells the server that this page is there, and then holds an answer that has no end, as a sign that pages are open.
 * Firefox drops what a page sends when it closes. One page of a browser holds it, since that opens six connections alone.
 */
export async function announcePage() {
  await fetch("arrived", { method: "POST" }).catch(() => {});
  await navigator.locks.request("open", async () => {
    for (;;) {
      await askText("open").catch(() => new Promise((next) => setTimeout(next, 10000)));
    }
  });
}
