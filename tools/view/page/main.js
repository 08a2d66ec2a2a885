// The page: what it shows of which stream, and the link to it in the address.
import { announcePage, askJson } from "./ask.js";
import { any, say } from "./dom.js";
import { Look } from "./look.js";

/** @param {string} mode "look" or "into" */
function showMode(mode) {
  for (const name of ["look", "into"]) {
    any(name).hidden = name !== mode;
    any(`mode-${name}`).setAttribute("aria-pressed", String(name === mode));
  }
}

/** @param {string} mode @param {import("./ask.js").Query} query */
function setLink(mode, query) {
  const pairs = Object.entries({ mode, ...query }).map(([name, value]) => `${name}=${value}`);
  history.replaceState(null, "", `#${pairs.join("&")}`);
}

/** @param {any} stream */
function describe(stream) {
  document.title = `${stream.name} – hmlfc view`;
  any("name").textContent = stream.name;
  say("notice", [stream.error, stream.warning].filter(Boolean).join("\n"));
  if (stream.error) return;
  any("shape").textContent =
    `${stream.rows} × ${stream.cols} views of ${stream.width} × ${stream.height}, ${stream.depth} bits · ${stream.coding}`;
}

async function begin() {
  announcePage();
  const stream = await askJson("stream");
  describe(stream);
  if (stream.error) return;
  const look = new Look(stream, (query) => setLink("look", query));
  const open = () => {
    const link = new URLSearchParams(location.hash.slice(1));
    showMode("look");
    look.open(link);
  };
  addEventListener("hashchange", open);
  open();
}

begin().catch((error) => say("notice", error.message));
