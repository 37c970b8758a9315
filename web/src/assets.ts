// Files beside the page, or inside it where the page is a single file.

export async function asset(name: string): Promise<ArrayBuffer> {
  const inside = document.getElementById(`asset-${name}`)
  if (inside) {
    const packed = Uint8Array.from(atob(inside.textContent ?? ''), (c) => c.charCodeAt(0))
    return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).arrayBuffer()
  }
  const response = await fetch(`./${name}`)
  if (!response.ok) throw new Error(`${name}: ${response.status}`)
  return response.arrayBuffer()
}

/** True where the page is a single file. */
export const single = () => document.getElementById('asset-engine.wasm') !== null
