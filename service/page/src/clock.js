// Where in time the page is, and how large what it draws.
import { count } from './words.js';

const $ = (id) => document.getElementById(id);

export function showTime({ history, player, driver }) {
  const entry = history.entry(player.seq), behind = history.last - player.seq, done = driver?.ended && player.atHead;
  const of = driver ? ` of ${driver.total}` : '', late = !driver && behind > 0 ? ` · ${count(behind, 'frame')} behind` : '';
  $('clock').textContent = entry ? `frame ${entry.seq}${of} · ${entry.time.toFixed(2)} s${late}` : 'no frame yet';
  $('play').textContent = player.playing && !done ? 'Pause' : 'Play';
  $('step-back').disabled = player.seq <= history.first;
  $('step').disabled = player.atHead && (!driver || driver.ended);
  $('newest').disabled = player.atHead;
  $('wait').hidden = history.length > 0;
  $('wait').textContent = driver ? 'Working out the first frame…' :
    'This session has answered no frame since you came. As soon as its simulator sends one, it is drawn here.';
  const slider = $('timeline');
  slider.setAttribute('aria-valuemin', history.first);
  slider.setAttribute('aria-valuemax', history.last);
  slider.setAttribute('aria-valuenow', player.seq);
  slider.setAttribute('aria-valuetext', $('clock').textContent);
}

const widest = 160; // pixels of the scale bar

/// The plan's scale bar, or the frame about the viewer's pane in 3D.
export function showScale(dimension, view) {
  $('scale').hidden = dimension === 3;
  $('eye-frame').hidden = dimension === 2 || !view.pane;
  if (dimension === 3) {
    const { x, y, width, height } = view.pane ?? {};
    Object.assign($('eye-frame').style, { left: `${x}px`, top: `${y}px`, width: `${width}px`, height: `${height}px` });
    return;
  }
  let metres = 1e-3;
  for (let power = 1e-3; power < 1e9; power *= 10) {
    for (const step of [1, 2, 5]) if (step * power * view.camera.scale <= widest) metres = step * power;
  }
  $('scale').querySelector('span').textContent = `${+metres.toPrecision(1)} m`;
  $('scale').querySelector('i').style.width = `${metres * view.camera.scale}px`;
}
