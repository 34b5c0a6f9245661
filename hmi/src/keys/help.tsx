// Help page with the table of keys.
import type { JSX } from 'preact';
import { Dialog } from '../parts/dialog';
import { helpOpen } from '../view';
import { JOG_KEYS, KEYS } from './table';

export function Help(): JSX.Element {
  return (
    <Dialog title="Help" open={helpOpen.value} onClose={() => (helpOpen.value = false)} class="help">
      <p>
        <a href="docs/index.html" target="_blank" rel="noopener">
          Documentation
        </a>
        : how to operate, explanations, reference, with search. It opens in a tab of its own.
      </p>
      <h3>Keyboard</h3>
      <table>
        <thead>
          <tr>
            <th scope="col">Key</th>
            <th scope="col">What it does</th>
          </tr>
        </thead>
        <tbody>
          {KEYS.map((key) => (
            <tr key={key.shown}>
              <td>
                <kbd>{key.shown}</kbd>
              </td>
              <td>{key.text}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <h3>With the keyboard armed (the switch of the jog panel)</h3>
      <table>
        <thead>
          <tr>
            <th scope="col">Key</th>
            <th scope="col">What it does</th>
          </tr>
        </thead>
        <tbody>
          {JOG_KEYS.map((key) => (
            <tr key={key.shown}>
              <td>
                <kbd>{key.shown}</kbd>
              </td>
              <td>{key.text}, while held or by one step</td>
            </tr>
          ))}
          <tr>
            <td>
              <kbd>Shift</kbd> + a jog key
            </td>
            <td>Rapid jog: at the axis' maximum velocity</td>
          </tr>
        </tbody>
      </table>
      <p class="hint">While you type in a field only Esc, F1 and F2 act. STOP is not an emergency stop.</p>
    </Dialog>
  );
}
