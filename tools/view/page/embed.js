// <script type="module" src="SITE/embed.js"></script> and <light-field src="SITE/"></light-field>: the page in another.
if (!customElements.get("light-field")) customElements.define("light-field", class extends HTMLElement {
  static observedAttributes = ["src"];

  attributeChangedCallback() {
    if (this.isConnected) this.connectedCallback();
  }

  connectedCallback() {
    const frame = document.createElement("iframe");
    const site = new URL(this.getAttribute("src") ?? "./", document.baseURI);
    if (!/(\/|\.html?)$/.test(site.pathname)) site.pathname += "/";
    frame.src = new URL("index.html", site).href;
    frame.allow = "fullscreen; accelerometer; gyroscope";
    frame.setAttribute("loading", "lazy");
    frame.title = this.getAttribute("title") ?? "Light field";
    frame.style.cssText = "display: block; width: 100%; height: 100%; border: 0";
    this.style.display = "block";
    this.replaceChildren();
    if (this.clientHeight === 0) this.style.height = "20rem"; // nobody has said one
    this.append(frame);
  }
});
