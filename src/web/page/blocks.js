// The data that the page carries, and the few tools that its other scripts share.
"use strict";

const page = {};

/** The element of that id. */
page.element = id => document.getElementById(id);

/** What the page shows, without its large arrays. */
page.data = JSON.parse(page.element("data").textContent);

/** Unpacks a text of packed.hpp: a promise of its bytes; none where it is missing or empty. */
page.unpack = async block => {
  if (!block) return new ArrayBuffer(0);
  const text = atob(block);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < packed.length; ++i) packed[i] = text.charCodeAt(i);
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(unpacked).arrayBuffer();
};

/** The bytes of the page's block of that id, which is taken away: it is not needed twice. */
page.bytes = async id => {
  const element = page.element(id);
  if (element) element.remove();
  return page.unpack(element && element.textContent);
};

/** A colour of the page's style, as CSS writes it. */
page.styleColour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** A number with its unit for people; a dash where there is none. */
page.shown = (value, digits, unit = "") =>
  Number.isFinite(value) ? value.toFixed(digits) + unit : "\u2013";

// Cividis and viridis, whose lightness grows evenly: they read the same without colour vision.
const ramps = {
  cividis: ["#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369",
    "#e1cc55", "#fee838"],
  viridis: ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58",
    "#b5de2b", "#fde725"],
};

/** The colour of a share of a ramp, [red, green, blue] from 0 to 255. */
page.rampColour = (name, share) => {
  const colours = ramps[name];
  const place = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
  const before = Math.min(Math.floor(place), colours.length - 2);
  return [1, 3, 5].map(i => {
    const a = parseInt(colours[before].slice(i, i + 2), 16);
    const b = parseInt(colours[before + 1].slice(i, i + 2), 16);
    return Math.round(a + (b - a) * (place - before));
  });
};

/** 256 colours of a ramp, four bytes each. */
page.rampBytes = name => {
  const bytes = new Uint8Array(1024);
  for (let i = 0; i < 256; ++i) bytes.set([...page.rampColour(name, i / 255), 255], 4 * i);
  return bytes;
};

/** Shows a text beside the pointer; none hides it. */
page.showTip = (text, x, y) => {
  const tip = page.element("tip");
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  tip.style.left = Math.min(x + 14, innerWidth - tip.offsetWidth - 4) + "px";
  tip.style.top = Math.min(y + 14, innerHeight - tip.offsetHeight - 4) + "px";
};
