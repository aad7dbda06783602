// One WebSocket to the server that sent this page. Questions that get one answer are promises, in their order.

export const streamAddress = () => `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/v1/stream`;

/// An answer of type "error", in words.
export class Refused extends Error {
  constructor({ code, message, pointer }) {
    super(pointer && !message.includes(pointer) ? `${message} (${pointer})` : message);
    this.code = code;
  }
}

export class Connection {
  /// `onStep(message, text)`: what comes unasked; `onClose(reason)`: not after close().
  constructor({ onStep, onClose } = {}) {
    this.waiting = [];
    this.socket = new WebSocket(streamAddress());
    this.opened = new Promise((resolve, reject) => {
      this.socket.onopen = resolve;
      this.socket.onerror = () => reject(new Error('The server does not answer.'));
    });
    this.opened.catch(() => {});
    this.socket.onmessage = ({ data }) => {
      const message = JSON.parse(data);
      if (message.type === 'step') return onStep?.(message, data);
      if (message.type === 'ended') return this.socket.close(1000, 'The session has ended.');
      const question = this.waiting.shift();
      if (!question) return;
      if (message.type === 'error') question.reject(new Refused(message));
      else question.resolve(message);
    };
    this.socket.onclose = ({ reason }) => {
      for (const question of this.waiting.splice(0)) question.reject(new Error(reason || 'The connection has ended.'));
      if (!this.closing) onClose?.(reason);
    };
  }

  async ask(message) {
    await this.opened;
    if (this.socket.readyState !== WebSocket.OPEN) throw new Error('The connection has ended.');
    return new Promise((resolve, reject) => {
      this.waiting.push({ resolve, reject });
      this.socket.send(JSON.stringify(message));
    });
  }

  close() {
    this.closing = true;
    this.socket.close();
  }
}
