// Trace files, and the session that plays them: opened and driven from here, watched like any other.
import { Connection } from './connection.js';

async function textOf(file) {
  if (!file.name.endsWith('.gz')) return file.text();
  return new Response(file.stream().pipeThrough(new DecompressionStream('gzip'))).text();
}

function parsed(text, what) {
  try {
    return JSON.parse(text);
  } catch (fault) {
    throw new Error(`${what} is not JSON: ${fault.message}`);
  }
}

/// `{name, scene, frames: [lines]}`; without frames there is one at time 0.
export function traceFromTexts(name, sceneText, framesText) {
  const scene = parsed(sceneText, 'The scene');
  if (scene.format !== 'gridcull.scene/1') throw new Error('The scene is of another kind: "format": "gridcull.scene/1" was expected.');
  const lines = (framesText ?? '').split('\n').filter((line) => line.trim());
  if (lines.length) {
    const head = parsed(lines.shift(), 'The first line of the frames');
    if (head.format !== 'gridcull.frames/1') throw new Error('The frames are of another kind: "format": "gridcull.frames/1" was expected in their first line.');
  }
  return { name, scene, frames: lines.length ? lines : ['{"time": 0}'] };
}

/// Which of the files is which is read from their content: names are up to people.
export async function traceFromFiles(files) {
  let scene, frames, name = 'trace';
  for (const file of files) {
    const text = await textOf(file);
    if (/^\s*\{\s*"format"\s*:\s*"gridcull\.frames/.test(text)) {
      frames = text;
    } else if (text.slice(0, 4000).includes('gridcull.scene/')) {
      scene = text;
      name = (file.webkitRelativePath?.split('/').at(-2) || file.name).replace(/\.json(\.gz)?$/, '');
      if (name === 'scene') name = 'trace';
    } else {
      throw new Error(`${file.name} is neither a scene (gridcull.scene/1) nor frames (gridcull.frames/1).`);
    }
  }
  if (!scene) throw new Error('The scene is missing: drop scene.json together with frames.jsonl.');
  return traceFromTexts(name, scene, frames);
}

/// The trace that the program was started with, or nothing.
export async function traceFromServer() {
  const scene = await fetch('/v1/trace/scene.json');
  if (scene.status !== 200) return null;
  const frames = await fetch('/v1/trace/frames.jsonl');
  return traceFromTexts('trace', await scene.text(), frames.status === 200 ? await frames.text() : '');
}

/// Drives a session of the server with a trace, a frame whenever one is asked for.
export class TraceDriver {
  constructor(trace, onClose) {
    this.trace = trace;
    this.sent = 0;
    this.connection = new Connection({ onClose });
  }

  async open(method, token) {
    const answer = await this.connection.ask({
      type: 'open', scene: this.trace.scene, method, name: this.trace.name, ...(token ? { token } : {}),
    });
    this.session = answer.session;
    this.token = answer.token;
    return answer;
  }

  get total() { return this.trace.frames.length; }
  get ended() { return this.sent >= this.total; }

  /// Seconds from the frame last sent to the next one.
  gap() {
    if (this.ended || this.sent === 0) return 0;
    return this.time(this.sent) - this.time(this.sent - 1);
  }

  time(index) {
    const found = /"time"\s*:\s*([-+.\deE]+)/.exec(this.trace.frames[index]);
    return found ? Number(found[1]) : 0;
  }

  async next() {
    const frame = parsed(this.trace.frames[this.sent], `Line ${this.sent + 2} of the frames`);
    const answer = await this.connection.ask({ type: 'frame', ...frame, seq: this.sent + 1, reply: 'none' });
    this.sent++;
    return answer;
  }

  explain(viewer, object) { return this.connection.ask({ type: 'explain', viewer, object }); }

  close() {
    this.connection.ask({ type: 'close' }).catch(() => {}).finally(() => this.connection.close());
  }
}
