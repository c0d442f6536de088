// Saves a figure as SVG, as PNG of 300 dots per inch, or its numbers as CSV. Nothing leaves the page.
(() => {
  const DPI = 300, PAGE_DPI = 96;
  const words = document.currentScript.dataset;
  const theme = document.getElementById("figure-theme").textContent;
  const light = {};
  for (const [, name, colour] of theme.split("@media")[0].matchAll(/(--[\w-]+):\s*(#\w+)/g)) light[name] = colour;

  // a standalone file: colours of the light page, a white background, links that older programs read
  function alone(svg) {
    const copy = svg.cloneNode(true);
    const ground = document.createElementNS("http://www.w3.org/2000/svg", "rect");
    ground.setAttribute("width", "100%");
    ground.setAttribute("height", "100%");
    ground.setAttribute("fill", "#ffffff");
    copy.prepend(ground);
    return new XMLSerializer().serializeToString(copy)
      .replace(/var\((--[\w-]+)\)/g, (whole, name) => light[name])
      .replace(/ href="#/g, ' xlink:href="#')
      .replace("<svg ", '<svg xmlns:xlink="http://www.w3.org/1999/xlink" ');
  }

  function save(blob, name) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }

  // PNG has its resolution in a separate chunk (pHYs), without which a word processor shows 96 dpi
  async function withResolution(blob) {
    const bytes = new Uint8Array(await blob.arrayBuffer());
    const chunk = new Uint8Array(21), view = new DataView(chunk.buffer);
    const perMetre = Math.round(DPI / 0.0254);
    view.setUint32(0, 9);
    chunk.set([112, 72, 89, 115], 4);
    view.setUint32(8, perMetre);
    view.setUint32(12, perMetre);
    chunk[16] = 1;
    let sum = ~0;
    for (const byte of chunk.subarray(4, 17)) {
      sum ^= byte;
      for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
    }
    view.setUint32(17, ~sum);
    return new Blob([bytes.subarray(0, 33), chunk, bytes.subarray(33)], { type: "image/png" });
  }

  async function png(svg) {
    const scale = DPI / PAGE_DPI;
    const image = new Image();
    const address = URL.createObjectURL(new Blob([alone(svg)], { type: "image/svg+xml" }));
    image.src = address;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = Math.round(svg.getAttribute("width") * scale);
    canvas.height = Math.round(svg.getAttribute("height") * scale);
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    URL.revokeObjectURL(address);
    const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
    return withResolution(blob);
  }

  async function csv(packed) {
    const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    const text = await new Response(stream).text();
    return new Blob(["\ufeff", text], { type: "text/csv" });
  }

  function button(text, label, make, name) {
    const made = document.createElement("button");
    made.type = "button";
    made.textContent = text;
    made.setAttribute("aria-label", label);
    made.title = label;
    made.addEventListener("click", async () => save(await make(), name));
    return made;
  }

  for (const plot of document.querySelectorAll(".plot[data-name]")) {
    const { name, csv: packed } = plot.dataset, svg = plot.querySelector("svg");
    const about = svg.getAttribute("aria-label");
    const row = document.createElement("div");
    row.className = "save";
    const vector = () => new Blob([alone(svg)], { type: "image/svg+xml" });
    row.append(button("SVG", `${words.svg}: ${about}`, vector, `${name}.svg`));
    row.append(button("PNG", `${words.png}: ${about}`, () => png(svg), `${name}.png`));
    if (packed) row.append(button("CSV", `${words.csv}: ${about}`, () => csv(packed), `${name}.csv`));
    plot.append(row);
  }
})();
