import { App } from './app'
import { single } from './assets'
import './style.css'
import './build.css'

const app = new App(document.getElementById('page')!)
void app.start()
// For tests and for a teacher's own scripts: the page as an object.
Object.assign(window, { hodograph: app })
if (!single() && 'serviceWorker' in navigator && !import.meta.env.DEV) {
  navigator.serviceWorker.register('./sw.js').catch(() => {})
}
