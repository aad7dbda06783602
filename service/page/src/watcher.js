// Watches one session: its world once, then every frame.
import { Connection } from './connection.js';

export class Watcher {
  constructor({ session, token, onStart, onStep, onClose }) {
    this.session = session;
    this.token = token;
    this.onStart = onStart;
    this.connection = new Connection({ onStep, onClose });
  }

  /// Also on a connection that watches already: the drawing then is that of another viewer.
  async watch(viewer) {
    this.viewer = viewer;
    const start = await this.connection.ask({
      type: 'watch', session: this.session, ...(this.token ? { token: this.token } : {}),
      ...(viewer === undefined ? {} : { viewer }),
    });
    this.onStart(start);
  }

  explain(viewer, object) { return this.connection.ask({ type: 'explain', viewer, object }); }
  close() { this.connection.close(); }
}
