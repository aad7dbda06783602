// Files dropped anywhere on the page, or chosen.
export function listenToFiles({ veil, input, onFiles }) {
  let within = 0;
  const hasFiles = (event) => event.dataTransfer?.types.includes('Files');
  addEventListener('dragenter', (event) => {
    if (!hasFiles(event)) return;
    within++;
    veil.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (hasFiles(event) && --within <= 0) veil.hidden = true;
  });
  addEventListener('dragover', (event) => { if (hasFiles(event)) event.preventDefault(); });
  addEventListener('drop', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    within = 0;
    veil.hidden = true;
    onFiles([...event.dataTransfer.files]);
  });
  input.addEventListener('change', () => {
    if (input.files.length) onFiles([...input.files]);
    input.value = '';
  });
}
