// The viewer of a report: pictures wiped, flipped, subtracted and laid out side by side, with one zoom for all.
// The page is complete without it; everything that it needs stands in the figures.
"use strict";

(() => {
  // ---- Numbers of pictures: as picture_values.h packs them.

  const bytesOf = (uri) => {
    const text = atob(uri.slice(uri.indexOf(",") + 1));
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  };

  /** Browsers of before 2023 may lack it: their values are those of the 8-bit pictures. */
  const canInflate = typeof DecompressionStream === "function";
  const inflated = async (uri) => {
    const stream = new Blob([bytesOf(uri)]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  const half = (bits) => {
    const exponent = (bits >> 10) & 31;
    const mantissa = bits & 1023;
    const sign = bits & 0x8000 ? -1 : 1;
    if (exponent === 31) return mantissa ? NaN : sign * Infinity;
    if (exponent === 0) return sign * mantissa * 2 ** -24;
    return sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
  };
  let halves = null;

  const unpackedHalves = (bytes, width, height, channels) => {
    if (!halves) halves = Float32Array.from({ length: 65536 }, (_, bits) => half(bits));
    const pixels = width * height;
    const values = new Float32Array(pixels * channels);
    for (let c = 0; c < channels; ++c) {
      const low = 2 * c * pixels;
      for (let y = 0; y < height; ++y) {
        let bits = 0;
        for (let at = y * width; at < (y + 1) * width; ++at) {
          bits = (bits + bytes[low + at] + (bytes[low + pixels + at] << 8)) & 0xffff;
          values[at * channels + c] = halves[bits];
        }
      }
    }
    return values;
  };

  const linearFromSrgb = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  const srgbBytes = (() => {  // of linear values in 0 … 1, in steps that no byte sees
    const steps = 1 << 14;
    const table = new Uint8ClampedArray(steps + 1);
    for (let i = 0; i <= steps; ++i) {
      const v = i / steps;
      table[i] = Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
    }
    return (v) => (v > 0 ? table[v < 1 ? (v * steps + 0.5) | 0 : steps] : 0);
  })();

  /** How numbers of a picture become bytes: light is sRGB-encoded, others are levels of grey. */
  const bytesFor = (channels) => (channels < 3 ? (v) => Math.round(255 * Math.min(1, Math.max(0, v || 0))) : srgbBytes);

  /** Values of an 8-bit picture: what it showed, back through exposure and range. */
  const bytesAsValues = (image, channels, shown) => {
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    const place = channels < 3 ? (v) => v : linearFromSrgb;
    const table = Float32Array.from({ length: 256 }, (_, byte) =>
      shown.low + (place(byte / 255) / 2 ** shown.exposure) * (shown.high - shown.low));
    const values = new Float32Array((data.length / 4) * channels);
    for (let i = 0; i < data.length / 4; ++i)
      for (let c = 0; c < channels; ++c) values[i * channels + c] = table[data[4 * i + Math.min(c, 2)]];
    return values;
  };

  // ---- Words

  const number = (value) => {
    if (Number.isNaN(value)) return "NaN";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const size = Math.abs(value);
    const text = size === 0 ? "0" : size >= 1e-3 && size < 1e5
      ? value.toFixed(Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(size)))))
      : value.toExponential(2);
    return text.replace("-", "−");
  };

  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  const colourMap = (name) => {
    const digits = document.getElementById("colour-maps").dataset[name];
    return Uint8Array.from({ length: 768 }, (_, i) => parseInt(digits.substr(2 * i, 2), 16));
  };

  // ---- One view for all pictures of the page: how far they are enlarged, and what stands in the middle.

  const view = { zoom: 1, x: 0.5, y: 0.5 };
  const viewers = [];
  const redrawAll = () => viewers.forEach((viewer) => viewer.redraw());
  const zoomBy = (factor, x = view.x, y = view.y) => {
    const zoom = Math.min(64, Math.max(1, view.zoom * factor));
    // The point (x, y) stays where it is.
    view.x = x + ((view.x - x) * view.zoom) / zoom;
    view.y = y + ((view.y - y) * view.zoom) / zoom;
    view.zoom = zoom;
    keepInside();
    redrawAll();
  };
  const keepInside = () => {
    const margin = 0.5 / view.zoom;
    view.x = Math.min(1 - margin, Math.max(margin, view.x));
    view.y = Math.min(1 - margin, Math.max(margin, view.y));
  };

  const MODES = [
    ["flip", "Flip", "A, and B while flipped (Space)"],
    ["wipe", "Wipe", "A left of the line, B right of it (W)"],
    ["difference", "Difference", "A − B (D)"],
    ["all", "All", "All pictures side by side (G)"],
  ];
  const modeOf = (name) =>
    name.startsWith("difference") ? "difference"
      : name === "side-by-side" || name === "stages" ? "all"
        : name === "wipe" ? "wipe" : "flip";

  class Viewer {
    constructor(section) {
      this.section = section;
      this.shown = {
        low: Number(section.dataset.low),
        high: Number(section.dataset.high),
        exposure: Number(section.dataset.exposure),
      };
      this.figures = [...section.querySelectorAll(".pictures > figure")];
      this.pictures = this.figures.map((figure) => {
        const image = figure.querySelector("img");
        return {
          name: figure.querySelector(".name").textContent,
          image,
          width: Number(image.getAttribute("width")),
          height: Number(image.getAttribute("height")),
          channels: Number(image.dataset.channels),
        };
      });
      this.width = this.pictures[0].width;
      this.height = this.pictures[0].height;
      this.a = Number(section.dataset.a);
      this.b = Number(section.dataset.b);
      this.mode = this.pictures.length > 1 ? modeOf(section.dataset.mode) : "flip";
      this.kind = section.dataset.mode === "difference:absolute" ? "absolute" : "signed";
      this.flipped = false;
      this.wipe = 0.5;
      this.stops = 0;  // beyond the exposure of the pictures as they stand there
      this.mark = null;  // the pixel whose values are told
      this.pointers = new Map();
      this.build();
      this.listen();
      this.ready = this.load();
    }

    async load() {
      for (const picture of this.pictures) {
        await picture.image.decode().catch(() => {});
        const { half: packed, mask } = picture.image.dataset;
        this.isExact = Boolean(packed) && canInflate;
        picture.values = this.isExact
          ? unpackedHalves(await inflated(packed), picture.width, picture.height, picture.channels)
          : bytesAsValues(picture.image, picture.channels, this.shown);
        picture.valid = mask && canInflate ? await inflated(mask) : null;
        picture.stops = null;
        this.redraw();
      }
      this.section.dataset.ready = "true";
    }

    // ---- What is there

    build() {
      const { section } = this;
      const button = (text, title, action, attributes = {}) => {
        const made = element("button", { type: "button", title, ...attributes }, text);
        made.addEventListener("click", (event) => {
          action(event);
          // Space flips after a click; who walks by keys stays where they are.
          if (event.detail > 0) this.stage.focus({ preventScroll: true });
        });
        return made;
      };
      this.modeButtons = MODES.map(([name, text, title]) =>
        button(text, title, () => this.setMode(name), { "data-mode": name }));
      const modes = element("div", { class: "group modes", role: "group", "aria-label": "How A and B are compared" },
        ...this.modeButtons);
      const list = (side) => {
        const select = element("select", { "aria-label": side === "a" ? "Picture A" : "Picture B" },
          ...this.pictures.map((picture, i) => element("option", { value: i }, `${i + 1}  ${picture.name}`)));
        select.addEventListener("change", () => this.choose(side, Number(select.value)));
        const letter = element("span", { class: `letter ${side}`, "aria-hidden": "true" }, side.toUpperCase());
        return [select, element("label", {}, letter, select)];
      };
      const [selectA, labelA] = list("a");
      const [selectB, labelB] = list("b");
      this.selects = { a: selectA, b: selectB };
      const swap = button("⇄", "Swap A and B (X)", () => this.swap(), { class: "icon", "aria-label": "Swap A and B" });
      const ab = element("div", { class: "group ab" }, labelA, swap, labelB);

      this.zoomText = element("output", { "aria-label": "Zoom" });
      const zoom = element("div", { class: "group", role: "group", "aria-label": "Zoom of all pictures" },
        button("−", "Smaller (−)", () => zoomBy(1 / 1.5), { class: "icon", "aria-label": "Zoom out" }),
        this.zoomText,
        button("+", "Larger (+)", () => zoomBy(1.5), { class: "icon", "aria-label": "Zoom in" }),
        button("Fit", "Whole pictures (0)", () => this.fit()));

      this.slider = element("input", { type: "range", min: -8, max: 8, step: 0.25, value: 0, "aria-label": "Exposure in stops" });
      this.slider.addEventListener("input", () => this.setStops(Number(this.slider.value)));
      this.stopsText = element("output");
      const exposure = element("div", { class: "group exposure" },
        element("span", { class: "caption" }, "Exposure"), this.slider, this.stopsText);

      this.canvas = element("canvas");
      this.tagA = element("div", { class: "tag left" });
      this.tagB = element("div", { class: "tag right" });
      this.legendCanvas = element("canvas", { width: 190, height: 1 });
      this.legendLow = element("span");
      this.legendMiddle = element("span");
      this.legendHigh = element("span");
      this.legend = element("div", { class: "legend" }, this.legendCanvas,
        element("div", {}, this.legendLow, this.legendMiddle, this.legendHigh));
      this.stage = element("div", { class: "stage", tabindex: "0", role: "application" },
        this.canvas, this.tagA, this.tagB, this.legend);
      this.stage.style.aspectRatio = `${this.width} / ${this.height}`;

      this.readout = element("div", { class: "readout", "aria-live": "polite" });
      const bar = element("div", { class: "bar", role: "toolbar", "aria-label": "Viewer" },
        ...(this.pictures.length > 1 ? [modes, ab] : []), zoom, exposure);
      this.viewer = element("div", { class: "viewer" }, bar, this.stage, this.readout);
      section.insertBefore(this.viewer, section.querySelector(".pictures"));
      section.classList.add("has-viewer");
      this.buildChoices(button);
      this.buildPairs(button);
      this.update();
    }

    buildChoices(button) {
      this.choices = this.figures.map((figure, i) => {
        const { name } = this.pictures[i];
        const side = (key) => button(key === "a" ? `${i + 1} A` : "B", `${name} as ${key.toUpperCase()}`, (event) => {
          event.stopPropagation();
          this.choose(key, i);
        }, { class: `to-${key}`, "aria-label": `Show ${name} as ${key.toUpperCase()}` });
        const buttons = this.pictures.length > 1 ? { a: side("a"), b: side("b") } : {};
        figure.append(element("div", { class: "choice" }, ...Object.values(buttons)));
        figure.addEventListener("click", (event) => this.choose(event.shiftKey ? "b" : "a", i));
        return buttons;
      });
    }

    buildPairs(button) {
      this.pairs = [...this.section.querySelectorAll(".pairs > li")].map((item) => {
        const { a, b, mode } = item.dataset;
        const pair = { a: Number(a), b: Number(b), mode };
        const name = item.querySelector(".name");
        pair.button = button(name.textContent, item.querySelector(".note")?.textContent ?? "", () => {
          this.a = pair.a;
          this.b = pair.b;
          if (mode.startsWith("difference:")) this.kind = mode === "difference:absolute" ? "absolute" : "signed";
          this.setMode(modeOf(mode));
        });
        item.prepend(pair.button);
        return pair;
      });
    }

    listen() {
      const { stage } = this;
      new ResizeObserver(() => this.redraw()).observe(stage);
      stage.addEventListener("pointerdown", (event) => {
        this.isHeld = true;
        this.press(event);
      });
      stage.addEventListener("blur", () => {
        this.isHeld = false;
      });
      stage.addEventListener("pointermove", (event) => this.move(event));
      for (const name of ["pointerup", "pointercancel"])
        stage.addEventListener(name, (event) => this.release(event));
      stage.addEventListener("dblclick", (event) => {
        const at = this.placeOf(event);
        view.zoom > 1 ? this.fit() : at && zoomBy(4, at.x, at.y);
      });
      stage.addEventListener("wheel", (event) => {
        // The page scrolls unless the viewer is in use.
        if (!event.ctrlKey && !this.isHeld) return;
        event.preventDefault();
        const at = this.placeOf(event);
        if (at) zoomBy(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.06 : 0.002)), at.x, at.y);
      }, { passive: false });
    }

    // ---- What a person does

    choose(side, index) {
      this[side] = index;
      if (side === "a") this.flipped = false;
      this.update();
    }

    swap() {
      [this.a, this.b] = [this.b, this.a];
      this.update();
    }

    setMode(mode) {
      if (mode === "difference" && this.mode === "difference")
        this.kind = this.kind === "signed" ? "absolute" : "signed";
      this.mode = mode;
      this.flipped = false;
      this.update();
    }

    flip() {
      if (this.pictures.length < 2) return;
      if (this.mode !== "flip") this.mode = "flip";
      this.flipped = !this.flipped;
      this.update();
    }

    setStops(stops) {
      this.stops = Math.max(-8, Math.min(8, stops));
      this.update();
    }

    fit() {
      Object.assign(view, { zoom: 1, x: 0.5, y: 0.5 });
      redrawAll();
    }

    /** Returns whether the key means something here. */
    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return false;
      const digit = /^Digit([1-9])$/.exec(event.code);
      if (digit) {
        const index = Number(digit[1]) - 1;
        if (index < this.pictures.length) this.choose(event.shiftKey ? "b" : "a", index);
        return true;
      }
      const step = event.shiftKey ? 10 : 1;
      const keys = {
        " ": () => this.flip(),
        d: () => this.pictures.length > 1 && this.setMode("difference"),
        w: () => this.pictures.length > 1 && this.setMode("wipe"),
        g: () => this.setMode(this.mode === "all" ? "flip" : "all"),
        x: () => this.swap(),
        "+": () => zoomBy(1.5, ...this.middle()),
        "=": () => zoomBy(1.5, ...this.middle()),
        "-": () => zoomBy(1 / 1.5, ...this.middle()),
        0: () => this.fit(),
        e: () => this.setStops(this.stops + 0.5),
        E: () => this.setStops(this.stops - 0.5),
        ArrowLeft: () => this.walk(-step, 0),
        ArrowRight: () => this.walk(step, 0),
        ArrowUp: () => this.walk(0, -step),
        ArrowDown: () => this.walk(0, step),
        Escape: () => this.fit(),
      };
      const action = keys[event.key] ?? keys[event.key.toLowerCase()];
      if (!action) return false;
      if (event.key.startsWith("Arrow") && document.activeElement !== this.stage) return false;
      action();
      return true;
    }

    /** What keys enlarge: the marked pixel, where there is one. */
    middle() {
      return this.mark ? [(this.mark.x + 0.5) / this.width, (this.mark.y + 0.5) / this.height] : [view.x, view.y];
    }

    walk(dx, dy) {
      const from = this.mark ?? { x: Math.floor(view.x * this.width), y: Math.floor(view.y * this.height) };
      this.mark = {
        x: Math.max(0, Math.min(this.width - 1, from.x + dx)),
        y: Math.max(0, Math.min(this.height - 1, from.y + dy)),
      };
      const half = 0.5 / view.zoom;
      const [x, y] = this.middle();
      view.x = Math.max(x - half, Math.min(x + half, view.x));
      view.y = Math.max(y - half, Math.min(y + half, view.y));
      keepInside();
      this.tell();
      redrawAll();
    }

    press(event) {
      this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      const grabs = this.mode === "wipe" && (this.isOverDivider(event) || (event.pointerType === "touch" && view.zoom === 1));
      this.drag = { x: event.clientX, y: event.clientY, moved: false, wipes: grabs };
      if (event.pointerType === "mouse" || view.zoom > 1 || grabs) this.stage.setPointerCapture(event.pointerId);
    }

    move(event) {
      const before = this.pointers.get(event.pointerId);
      if (!before) {
        this.stage.classList.toggle("over-divider", this.mode === "wipe" && this.isOverDivider(event));
        this.point(event);
        return;
      }
      const now = { x: event.clientX, y: event.clientY };
      if (this.pointers.size === 2) {
        const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
        const distance = (p) => Math.hypot(p.x - other.x, p.y - other.y);
        const at = this.placeOf({ clientX: (now.x + other.x) / 2, clientY: (now.y + other.y) / 2 });
        if (at) zoomBy(distance(now) / Math.max(1, distance(before)), at.x, at.y);
        this.drag.moved = true;
      } else if (this.drag.wipes) {
        const box = this.cellBox();
        this.wipe = Math.max(0, Math.min(1, (now.x - this.stage.getBoundingClientRect().left - box.x) / box.width));
        this.drag.moved = true;
        this.redraw();
      } else if (this.drag.moved || Math.hypot(now.x - this.drag.x, now.y - this.drag.y) > 4) {
        const box = this.cellBox();
        view.x -= (now.x - before.x) / (box.width * view.zoom);
        view.y -= (now.y - before.y) / (box.height * view.zoom);
        keepInside();
        this.drag.moved = true;
        redrawAll();
      }
      this.pointers.set(event.pointerId, now);
      this.point(event);
    }

    release(event) {
      if (!this.pointers.delete(event.pointerId) || this.pointers.size > 0) return;
      if (event.type === "pointerup" && !this.drag.moved) {
        this.point(event);
        if (this.mode === "flip" && event.pointerType === "touch") this.flip();
        const cell = this.mode === "all" ? this.cellAt(event) : -1;
        if (cell >= 0) this.choose(event.shiftKey ? "b" : "a", cell);
      }
    }

    /** The pixel under the cursor is told of, and stays so when the cursor leaves. */
    point(event) {
      const at = this.placeOf(event);
      if (!at) return;
      const x = Math.floor(at.x * this.width);
      const y = Math.floor(at.y * this.height);
      if (x < 0 || y < 0 || x >= this.width || y >= this.height) return;
      if (this.mark && this.mark.x === x && this.mark.y === y) return;
      this.mark = { x, y };
      this.tell();
      this.redraw();
    }

    isOverDivider(event) {
      const box = this.cellBox();
      return Math.abs(event.clientX - this.stage.getBoundingClientRect().left - box.x - this.wipe * box.width) < 12;
    }

    // ---- Where things are, in the stage's own pixels

    /** The pictures of "All" stand in the rows that leave them largest. */
    columns() {
      if (this.mode !== "all") return 1;
      const { clientWidth: width, clientHeight: height } = this.stage;
      let best = 1;
      let largest = 0;
      for (let columns = 1; columns <= this.pictures.length; ++columns) {
        const rows = Math.ceil(this.pictures.length / columns);
        const size = Math.min(width / columns / this.width, height / rows / this.height);
        if (size > largest * 1.001) [best, largest] = [columns, size];
      }
      return best;
    }

    /** Of the cell with this number: the part of the stage that a whole picture fills when it is fitted. */
    cellBox(index = 0) {
      const columns = this.columns();
      const rows = this.mode === "all" ? Math.ceil(this.pictures.length / columns) : 1;
      const gap = this.mode === "all" ? 4 : 0;
      const cell = { width: this.stage.clientWidth / columns - gap, height: this.stage.clientHeight / rows - gap };
      const scale = Math.min(cell.width / this.width, cell.height / this.height);
      const width = scale * this.width;
      const height = scale * this.height;
      // All of them together stand in the middle.
      const left = (this.stage.clientWidth - columns * (width + gap)) / 2;
      const top = (this.stage.clientHeight - rows * (height + gap)) / 2;
      return {
        x: left + (index % columns) * (width + gap) + gap / 2,
        y: top + Math.floor(index / columns) * (height + gap) + gap / 2,
        width,
        height,
      };
    }

    cellAt(event) {
      const frame = this.stage.getBoundingClientRect();
      const x = event.clientX - frame.left;
      const y = event.clientY - frame.top;
      const count = this.mode === "all" ? this.pictures.length : 1;
      for (let i = 0; i < count; ++i) {
        const box = this.cellBox(i);
        if (x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height) return i;
      }
      return -1;
    }

    /** In the picture, from 0 to 1; null beside all of them. */
    placeOf(event) {
      const cell = this.cellAt(event);
      if (cell < 0) return null;
      const frame = this.stage.getBoundingClientRect();
      const box = this.cellBox(cell);
      return {
        x: view.x + ((event.clientX - frame.left - box.x) / box.width - 0.5) / view.zoom,
        y: view.y + ((event.clientY - frame.top - box.y) / box.height - 0.5) / view.zoom,
      };
    }

    // ---- What is drawn

    /** A picture at the chosen exposure. */
    rendered(picture) {
      if (picture.stops === this.stops && picture.canvas) return picture.canvas;
      if (!picture.values) return picture.image;
      const { width, height, channels, values } = picture;
      const canvas = picture.canvas ?? element("canvas", { width, height });
      const context = canvas.getContext("2d");
      const image = context.createImageData(width, height);
      const scale = 2 ** (this.shown.exposure + this.stops) / (this.shown.high - this.shown.low);
      const offset = -this.shown.low * scale;
      const byte = bytesFor(channels);
      for (let i = 0; i < width * height; ++i) {
        for (let c = 0; c < 3; ++c) {
          const own = channels === 1 ? 0 : c;
          image.data[4 * i + c] = own < channels ? byte(values[i * channels + own] * scale + offset) : 0;
        }
        image.data[4 * i + 3] = 255;
      }
      context.putImageData(image, 0, 0);
      picture.canvas = canvas;
      picture.stops = this.stops;
      return canvas;
    }

    isValid(picture, pixel) {
      return !picture.valid || picture.valid[pixel] === 1;
    }

    /** A − B, and what its colours span: what a hundredth of the pixels exceeds, but no less than a twentieth
        of the largest, as the program has it. */
    difference() {
      const [a, b] = [this.pictures[this.a], this.pictures[this.b]];
      if (!a.values || !b.values) return null;
      const key = `${this.a} ${this.b} ${this.kind} ${this.stops}`;
      if (this.subtracted?.key === key) return this.subtracted;
      const { width, height, channels } = a;
      const pixels = width * height;
      const worst = new Float32Array(pixels);
      for (let i = 0; i < pixels; ++i) {
        if (!this.isValid(a, i) || !this.isValid(b, i)) {
          worst[i] = NaN;
          continue;
        }
        for (let c = 0; c < channels; ++c) {
          const apart = a.values[i * channels + c] - b.values[i * channels + c];
          if (Number.isNaN(apart) || Math.abs(apart) > Math.abs(worst[i])) worst[i] = apart;
        }
      }
      const sizes = worst.filter(Number.isFinite).map(Math.abs).sort();
      const largest = sizes.length ? sizes[sizes.length - 1] : 0;
      const extent = (Math.max(sizes.length ? sizes[Math.floor(0.99 * (sizes.length - 1))] : 0, largest / 20) || 1)
        * 2 ** -this.stops;
      const canvas = element("canvas", { width, height });
      const context = canvas.getContext("2d");
      const image = context.createImageData(width, height);
      const map = colourMap(this.kind);
      for (let i = 0; i < pixels; ++i) {
        const part = this.kind === "signed" ? 0.5 + worst[i] / extent / 2 : Math.abs(worst[i]) / extent;
        const entry = 3 * Math.max(0, Math.min(255, Math.floor(part * 256)));
        for (let c = 0; c < 3; ++c) image.data[4 * i + c] = Number.isNaN(worst[i]) ? 96 : map[entry + c];
        image.data[4 * i + 3] = 255;
      }
      context.putImageData(image, 0, 0);
      this.subtracted = { key, canvas, extent };
      return this.subtracted;
    }

    redraw() {
      if (this.waits) return;
      this.waits = true;
      requestAnimationFrame(() => {
        this.waits = false;
        this.draw();
      });
    }

    draw() {
      const { stage, canvas } = this;
      const sharp = window.devicePixelRatio || 1;
      const [width, height] = [Math.round(stage.clientWidth * sharp), Math.round(stage.clientHeight * sharp)];
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      const context = canvas.getContext("2d");
      context.setTransform(sharp, 0, 0, sharp, 0, 0);
      context.clearRect(0, 0, stage.clientWidth, stage.clientHeight);
      stage.classList.toggle("zoomed", view.zoom > 1);
      if (this.mode === "all") {
        this.pictures.forEach((picture, i) => {
          const box = this.cellBox(i);
          this.drawIn(context, box, this.rendered(picture));
          this.drawName(context, box, i);
        });
      } else if (this.mode === "difference") {
        const apart = this.difference();
        if (apart) this.drawIn(context, this.cellBox(), apart.canvas);
        this.drawLegend(apart);
      } else if (this.mode === "wipe") {
        const box = this.cellBox();
        this.drawIn(context, box, this.rendered(this.pictures[this.a]));
        this.drawIn(context, { ...box, from: this.wipe }, this.rendered(this.pictures[this.b]));
        this.drawDivider(context, box);
      } else {
        this.drawIn(context, this.cellBox(), this.rendered(this.pictures[this.flipped ? this.b : this.a]));
      }
      this.zoomText.textContent = `${Math.round((100 * this.cellBox().width * view.zoom * sharp) / this.width)} %`;
    }

    /** The part of a picture that the view shows, and the marked pixel; `from` cuts off its left. */
    drawIn(context, box, source) {
      context.save();
      context.beginPath();
      const cut = (box.from ?? 0) * box.width;
      context.rect(box.x + cut, box.y, box.width - cut, box.height);
      context.clip();
      const width = box.width * view.zoom;
      const height = box.height * view.zoom;
      const x = box.x + box.width / 2 - view.x * width;
      const y = box.y + box.height / 2 - view.y * height;
      // Pixels have edges once they are enlarged.
      context.imageSmoothingEnabled = (width * (window.devicePixelRatio || 1)) / this.width < 1.5;
      context.imageSmoothingQuality = "high";
      context.drawImage(source, x, y, width, height);
      if (this.mark && (view.zoom > 1 || this.mode === "all")) {
        const size = Math.max(5, width / this.width);
        const middle = { x: x + ((this.mark.x + 0.5) * width) / this.width, y: y + ((this.mark.y + 0.5) * height) / this.height };
        for (const [colour, line] of [["rgb(0 0 0 / 75%)", 3], ["#ffffff", 1]]) {
          context.strokeStyle = colour;
          context.lineWidth = line;
          context.strokeRect(middle.x - size / 2, middle.y - size / 2, size, size);
        }
      }
      context.restore();
    }

    drawName(context, box, index) {
      const isChosen = index === this.a || index === this.b;
      const mark = index === this.a ? "A " : index === this.b ? "B " : "";
      const style = getComputedStyle(this.stage);
      context.save();
      context.font = `13px ${style.fontFamily}`;
      context.textBaseline = "middle";
      let text = `${mark}${index + 1} ${this.pictures[index].name}`;
      while (text.length > 4 && context.measureText(text).width > box.width - 22) text = `${text.slice(0, -2)}…`;
      context.fillStyle = "rgb(12 12 13 / 74%)";
      context.beginPath();
      context.roundRect(box.x + 6, box.y + 6, context.measureText(text).width + 14, 22, 4);
      context.fill();
      context.fillStyle = "#f3f3f1";
      context.fillText(text, box.x + 13, box.y + 17.5);
      if (isChosen) {
        context.strokeStyle = style.getPropertyValue(index === this.a ? "--a" : "--b");
        context.lineWidth = 2;
        context.strokeRect(box.x + 1, box.y + 1, box.width - 2, box.height - 2);
      }
      context.restore();
    }

    drawDivider(context, box) {
      const x = box.x + this.wipe * box.width;
      const y = box.y + box.height / 2;
      context.save();
      context.strokeStyle = "rgb(0 0 0 / 60%)";
      context.lineWidth = 4;
      context.strokeRect(x, box.y, 0, box.height);
      context.strokeStyle = "#ffffff";
      context.lineWidth = 2;
      context.strokeRect(x, box.y, 0, box.height);
      context.fillStyle = "#ffffff";
      context.beginPath();
      context.arc(x, y, 13, 0, 2 * Math.PI);
      context.fill();
      context.strokeStyle = "#303234";
      context.lineWidth = 1.6;
      context.lineCap = context.lineJoin = "round";
      for (const side of [-1, 1]) {
        context.beginPath();
        context.moveTo(x + side * 3, y - 4);
        context.lineTo(x + side * 7, y);
        context.lineTo(x + side * 3, y + 4);
        context.stroke();
      }
      context.restore();
    }

    drawLegend(apart) {
      if (!apart) return;
      const context = this.legendCanvas.getContext("2d");
      const map = colourMap(this.kind);
      for (let x = 0; x < 190; ++x) {
        const entry = 3 * Math.floor((256 * x) / 190);
        context.fillStyle = `rgb(${map[entry]} ${map[entry + 1]} ${map[entry + 2]})`;
        context.fillRect(x, 0, 1, 1);
      }
      this.legendLow.textContent = this.kind === "signed" ? number(-apart.extent) : "0";
      this.legendMiddle.textContent = this.kind === "signed" ? "A − B" : "|A − B|";
      this.legendHigh.textContent = number(apart.extent);
    }

    // ---- What is said

    update() {
      const { mode } = this;
      for (const button of this.modeButtons) button.setAttribute("aria-pressed", button.dataset.mode === mode);
      this.selects.a.value = this.a;
      this.selects.b.value = this.b;
      this.choices?.forEach((buttons, i) => {
        for (const [side, button] of Object.entries(buttons)) button.setAttribute("aria-pressed", this[side] === i);
        this.figures[i].classList.toggle("is-a", this.a === i);
        this.figures[i].classList.toggle("is-b", this.b === i && this.a !== i && this.pictures.length > 1);
      });
      this.pairs?.forEach((pair) => pair.button.setAttribute("aria-pressed",
        pair.a === this.a && pair.b === this.b && modeOf(pair.mode) === mode));
      const tag = (element, side, isShown) => {
        element.hidden = !isShown || this.pictures.length < 2;
        element.replaceChildren(
          Object.assign(document.createElement("span"), { className: `letter ${side}`, textContent: side.toUpperCase() }),
          this.pictures[this[side]].name);
      };
      tag(this.tagA, "a", mode === "wipe" || mode === "difference" || (mode === "flip" && !this.flipped));
      tag(this.tagB, "b", mode === "wipe" || mode === "difference" || (mode === "flip" && this.flipped));
      this.tagB.className = mode === "flip" ? "tag left" : "tag right";
      this.legend.hidden = mode !== "difference";
      this.slider.value = this.stops;
      this.stopsText.textContent = this.stopsOf(this.stops);
      this.stage.setAttribute("aria-label", this.description());
      this.tell();
      this.redraw();
    }

    /** "+1.50 EV": the exposure of the pictures and so many stops. */
    stopsOf(more) {
      const exposure = this.shown.exposure + more;
      return `${exposure < 0 ? "−" : "+"}${Math.abs(exposure).toFixed(2)} EV`;
    }

    description() {
      const [a, b] = [this.pictures[this.a].name, this.pictures[this.b].name];
      if (this.mode === "all") return `All ${this.pictures.length} pictures side by side`;
      if (this.mode === "difference") return `Difference of ${a} and ${b}`;
      if (this.mode === "wipe") return `${a} left of a line, ${b} right of it`;
      return `${this.flipped ? b : a}. Arrow keys read pixels`;
    }

    valuesAt(index, pixel) {
      const { values, channels } = this.pictures[index];
      return values ? [...values.subarray(pixel * channels, (pixel + 1) * channels)] : [];
    }

    /** The line below the picture. */
    tell() {
      const { mark, readout } = this;
      if (!mark) {
        readout.replaceChildren(this.hint());
        return;
      }
      const pixel = mark.y * this.width + mark.x;
      const value = (who, numbers, swatch) => {
        const made = element("span", { class: "value" });
        if (swatch) {
          const box = element("span", { class: "swatch" });
          box.style.background = swatch;
          made.append(box);
        }
        made.append(element("span", { class: "who" }, who), numbers.map(number).join("  "));
        return made;
      };
      const colour = (index) => {
        const scale = 2 ** (this.shown.exposure + this.stops) / (this.shown.high - this.shown.low);
        const byte = bytesFor(this.pictures[index].channels);
        const bytes = this.valuesAt(index, pixel).map((v) => byte((v - this.shown.low) * scale));
        return bytes.length === 1 ? `rgb(${bytes[0]} ${bytes[0]} ${bytes[0]})` : `rgb(${bytes[0]} ${bytes[1]} ${bytes[2] ?? 0})`;
      };
      const chosen = this.mode === "all" ? this.pictures.map((_, i) => i)
        : this.pictures.length > 1 ? [this.a, this.b] : [0];
      const parts = [element("span", { class: "place" },
        `x ${mark.x}, y ${mark.y}${this.isExact ? "" : `, of 8 bits at ${this.stopsOf(0)}`}`)];
      for (const [place, index] of chosen.entries()) {
        const who = this.mode === "all" ? `${index + 1} ${this.pictures[index].name}`
          : this.pictures.length > 1 ? "AB"[place] : this.pictures[0].name;
        parts.push(value(who, this.valuesAt(index, pixel), colour(index)));
      }
      if (this.mode !== "all" && this.pictures.length > 1) {
        const [a, b] = chosen.map((index) => this.valuesAt(index, pixel));
        parts.push(value("A − B", a.map((v, c) => v - b[c])));
        if (chosen.some((index) => !this.isValid(this.pictures[index], pixel)))
          parts.push(element("span", { class: "hint" }, "not valid: metrics skip this pixel"));
      }
      readout.replaceChildren(...parts);
    }

    hint() {
      const hint = element("span", { class: "hint" }, `${matchMedia("(pointer: coarse)").matches ? "Touch" : "Point at"} a picture to read its values. `);
      const keys = element("span", { class: "keys" });
      const add = (key, text) => keys.append(element("kbd", {}, key), ` ${text}  `);
      if (this.pictures.length > 1) {
        add("Space", "flips");
        add(`1–${Math.min(9, this.pictures.length)}`, "chooses A, with Shift B");
        add("W", "wipes");
        add("D", "difference");
        add("G", "all");
      }
      add("+ −", "zoom");
      add("E", "brighter, with Shift darker");
      hint.append(keys);
      return hint;
    }
  }

  for (const section of document.querySelectorAll("section.gallery"))
    if (section.querySelector(".pictures > figure")) viewers.push(new Viewer(section));

  // Keys are of the viewer that has the focus, else of the one that most of the window shows.
  const current = () => {
    const focused = viewers.find((viewer) => viewer.section.contains(document.activeElement));
    if (focused) return focused;
    const seen = ({ stage }) => {
      const box = stage.getBoundingClientRect();
      return Math.min(box.bottom, window.innerHeight) - Math.max(box.top, 0);
    };
    return viewers.filter((viewer) => seen(viewer) > 0).sort((a, b) => seen(b) - seen(a))[0] ?? viewers[0];
  };
  document.addEventListener("keydown", (event) => {
    const { target } = event;
    const isTyping = target.closest?.("input, textarea, select, summary");
    const presses = event.key === " " && target.closest?.("button, a");
    const scrolls = event.key === " " && target.closest?.(".scroll");
    if (isTyping || presses || scrolls || viewers.length === 0) return;
    if (current().key(event)) event.preventDefault();
  });
})();
