// <script type="module" src="SITE/embed.js"></script> and <light-field src="SITE/"></light-field>: the page in another.
if (!customElements.get("light-field")) customElements.define("light-field", class extends HTMLElement {
  connectedCallback() {
    const frame = document.createElement("iframe");
    frame.src = new URL("index.html", new URL(this.getAttribute("src") ?? "./", document.baseURI)).href;
    frame.allow = "fullscreen; accelerometer; gyroscope";
    frame.setAttribute("loading", "lazy");
    frame.title = this.getAttribute("title") ?? "Light field";
    frame.style.cssText = "display: block; width: 100%; height: 100%; min-height: 20rem; border: 0";
    this.style.display = "block";
    this.replaceChildren(frame);
  }
});
