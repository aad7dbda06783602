// The keyboard. Keys go to the page unless one types or moves within a control that has its own use for them.

/// `actions`: key as in KeyboardEvent.key, with "Shift+" before arrows -> what it does.
export function listenToKeys(actions) {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector('dialog[open]')) return;
    const at = event.target, typing = at.matches('input:not([type=checkbox]), select, textarea');
    if (typing) {
      if (event.key === 'Escape') at.blur();
      return;
    }
    // Space and Enter press what has the focus.
    if (event.key === ' ' && at.matches('button, input, summary, a')) return;
    const action = actions[event.shiftKey && event.key.startsWith('Arrow') ? `Shift+${event.key}` : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
