// The page: what it shows of which stream, and the link to it in the address.
import { announcePage, askJson } from "./ask.js";
import { linkTo } from "./camera.js";
import { any, say } from "./dom.js";
import { Into } from "./into.js";
import { Look } from "./look.js";
import { ServerFrames } from "./server_frames.js";

const MODES = ["look", "into"];

/**
 * @param {string} shown one of MODES
 */
function showMode(shown) {
  for (const mode of MODES) {
    any(mode).hidden = mode !== shown;
    any(`mode-${mode}`).setAttribute("aria-pressed", String(mode === shown));
  }
  any("coding").hidden = shown === "look";
}

/**
 * @param {any} stream
 */
function describe(stream) {
  document.title = `${stream.name} – hmlfc view`;
  any("name").textContent = stream.name;
  say("warning", [stream.error, stream.warning].filter(Boolean).join("\n"));
  for (const mode of MODES) any(`mode-${mode}`).hidden = Boolean(stream.error);
  if (stream.error) return;
  any("shape").textContent = `${stream.rows} × ${stream.cols} views of ${stream.width} × ${stream.height}`;
  any("coding").textContent = `, ${stream.depth} bits · ${stream.coding}`;
}

async function begin() {
  void announcePage();
  const stream = await askJson("stream");
  describe(stream);
  if (stream.error) return;
  /** @type {Record<string, string>} */
  const links = { look: "#mode=look" };
  const keep = (/** @type {string} */ mode) => (/** @type {import("./ask.js").Query} */ query) => {
    links[mode] = linkTo({ mode, ...query });
    if (!any(mode).hidden) history.replaceState(null, "", links[mode]);
  };
  for (const mode of MODES) showMode(mode); // both have to be seen once, to be laid out
  const look = new Look(await ServerFrames.open(stream), keep("look"));
  const shows = { look, into: new Into(stream, keep("into")) };
  const open = () => {
    const link = new URLSearchParams(location.hash.slice(1));
    const mode = link.get("mode") === "into" ? "into" : "look";
    showMode(mode);
    shows[mode].open(link);
  };
  addEventListener("hashchange", () => {
    open();
    any(any("into").hidden ? "frame" : "picture").focus({ preventScroll: true }); // which takes the keys
  });
  any("mode-look").addEventListener("click", () => (location.hash = links.look));
  any("mode-into").addEventListener("click", () => {
    links.into ??= linkTo({ mode: "into", ...look.nearestView() });
    location.hash = links.into;
  });
  open();
}

begin().catch((error) => say("warning", error.message));
