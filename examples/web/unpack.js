// unpack.js - what stands in the page: elements by their id, modules and bodies as base64 of gzip.

performance.mark('script');
const find = (id) => document.getElementById(id);

async function unpacked(id) {
  const text = find(id).textContent;
  const packed = Uint8Array.fromBase64?.(text) ??  // since 2025, and far faster
    Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const plain = new Response(packed).body.pipeThrough(new DecompressionStream('gzip'));
  return new Response(plain, {headers: {'content-type': 'application/wasm'}});
}
