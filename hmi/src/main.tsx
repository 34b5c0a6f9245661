// Entry point of the page.
import { effect } from '@preact/signals';
import { render } from 'preact';
import './style/base.css';
import './style/parts.css';
import './style/layout.css';
import './style/axes.css';
import './style/panels.css';
import './style/cards.css';
import './style/scope.css';
import { App } from './app';
import { listen } from './keys/handler';
import { loadHistory } from './link/history';
import { pairFromAddress } from './link/pairing';
import { hello, machineState, status } from './link/state';
import { connect, whenOpen } from './link/socket';
import { keepControl } from './link/control';
import { watch } from './view';

effect(() => {
  document.title = [hello.value?.rack, status.value && machineState.value, 'Motionrack'].filter(Boolean).join(' · ');
});

const pairing = pairFromAddress();
watch();
listen();
whenOpen(() => void loadHistory());
keepControl();
const root = document.getElementById('page');
if (root !== null) render(<App />, root);
void pairing.finally(connect);
