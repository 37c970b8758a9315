// The engine in Node, for the build and the tests.
import { readFile } from 'node:fs/promises'

export async function engine(path, font) {
  const { instance } = await WebAssembly.instantiate(await readFile(path), {})
  const of = instance.exports
  const put = (bytes) => {
    // First the address: making room may move the memory.
    const address = of.input(bytes.length)
    new Uint8Array(of.memory.buffer, address, bytes.length).set(bytes)
  }
  if (font) {
    put(await readFile(font))
    if (!of.font()) throw new Error(`${font} is no font`)
  }
  const ask = (message) => {
    put(new TextEncoder().encode(JSON.stringify(message)))
    const length = of.call()
    return JSON.parse(new TextDecoder().decode(new Uint8Array(of.memory.buffer, of.output(), length)))
  }
  // The message of the panic that ended the engine.
  ask.fault = () => new TextDecoder().decode(new Uint8Array(of.memory.buffer, of.fault(), of.fault_length()))
  return ask
}
