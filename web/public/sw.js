// Keeps the page for use without a network. The build fills in the names of the files and their common hash.
const KEPT = "KEPT"
const CACHE = 'hodograph-VERSION'
self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(KEPT)).then(() => self.skipWaiting()))
})
self.addEventListener('activate', (event) => {
  const old = async () => {
    for (const name of await caches.keys()) if (name.startsWith('hodograph-') && name !== CACHE) await caches.delete(name)
    await self.clients.claim()
  }
  event.waitUntil(old())
})
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET') return
  const kept = caches.open(CACHE).then((cache) => cache.match(event.request, { ignoreSearch: true }))
  event.respondWith(kept.then((found) => found ?? fetch(event.request)))
})
