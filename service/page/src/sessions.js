// The start page: which sessions the server has.
import { count } from './words.js';

export class SessionList {
  constructor({ table, empty, onChoose, onList, onFault }) {
    Object.assign(this, { table, empty, onChoose, onList, onFault, sessions: [] });
    this.body = table.querySelector('tbody');
    this.poll();
  }

  async poll() {
    try {
      const answer = await fetch('/v1/sessions');
      this.sessions = (await answer.json()).sessions;
      this.show();
      this.onList(this.sessions);
    } catch {
      this.onFault();
    }
    setTimeout(() => this.poll(), 1000);
  }

  /// Rows stay where they are, so that the focus does too.
  show() {
    this.table.hidden = !this.sessions.length;
    this.empty.hidden = this.sessions.length > 0;
    const rows = new Map([...this.body.rows].map((row) => [row.dataset.session, row]));
    for (const session of this.sessions) {
      let row = rows.get(session.session);
      if (!row) this.body.append(row = this.row(session));
      rows.delete(session.session);
      const texts = [session.method, `${session.dimension}D`, session.objects.toLocaleString('en'), session.viewers, session.seq.toLocaleString('en'),
        session.connected ? 'here' : 'away'];
      texts.forEach((text, i) => {
        if (row.cells[i + 1].textContent !== String(text)) row.cells[i + 1].textContent = text;
      });
    }
    for (const row of rows.values()) row.remove();
  }

  row(session) {
    const row = document.createElement('tr');
    row.dataset.session = session.session;
    for (let i = 0; i < 7; i++) row.insertCell();
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = session.name ? `${session.name} (${session.session.slice(0, 8)})` : session.session;
    button.title = `Watch this session of ${count(session.objects, 'object')}`;
    button.addEventListener('click', () => this.onChoose(session.session));
    row.cells[0].append(button);
    return row;
  }
}
