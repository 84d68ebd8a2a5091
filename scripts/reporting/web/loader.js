// Unpacks what the page carries, each a zlib stream in base 85, and runs the script that is among it.
"use strict";
(() => {
  const digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;.=>?@^_`{|}~";
  const values = new Uint8Array(128);
  for (let i = 0; i < digits.length; ++i) values[digits.charCodeAt(i)] = i;
  // Five digits are four bytes; a last group of k + 1 digits is k bytes, as if it went on with the largest digit.
  const decoded = (text) => {
    const bytes = new Uint8Array(Math.ceil(text.length / 5) * 4);
    for (let from = 0, to = 0; from < text.length; from += 5) {
      let word = 0;
      for (let k = from; k < from + 5; ++k) word = word * 85 + (k < text.length ? values[text.charCodeAt(k)] : 84);
      for (let shift = 24; shift >= 0; shift -= 8) bytes[to++] = word >>> shift;
    }
    return bytes.subarray(0, Math.floor(text.length * 4 / 5));
  };
  const unpacked = async (id) => {
    const stream = new Blob([decoded(document.getElementById(id).textContent)]).stream();
    return new Response(stream.pipeThrough(new DecompressionStream("deflate")));
  };
  const text = async (id) => (await unpacked(id)).text();
  const tell = (error) => {
    const place = document.createElement("p");
    place.className = "notice";
    place.setAttribute("role", "alert");
    place.textContent = `The interactive parts could not start: ${error && error.message || error}. Tables and verdict are complete.`;
    document.querySelector("header").append(place);
  };
  if (typeof DecompressionStream === "undefined") {
    tell("this browser is too old to unpack them (it has no DecompressionStream)");
    return;
  }
  Promise.all([text("data"), unpacked("arrays").then((response) => response.arrayBuffer()), text("program")]).then(([data, arrays, program]) => {
    window.touchmark = { data: JSON.parse(data), arrays: new Uint8Array(arrays), tell };
    const script = document.createElement("script");
    script.textContent = program;
    document.body.append(script);
  }).catch((error) => { tell(error); throw error; });
})();
