// Dialog that asks for a pairing code, and dialog that creates codes for others.
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import { commandFor, sentence, whyNot } from '../link/commands';
import { codeText, dialogOpen, inviteOpen, nameText, pair, whyNotPaired } from '../link/pairing';
import { Dialog } from '../parts/dialog';
import { Button, Choice, Field } from '../parts/ui';

const close = (): void => void (dialogOpen.value = false);

async function send(): Promise<void> {
  localStorage.setItem('motionrack.name', nameText.value.trim());
  try {
    await pair(codeText.value, nameText.value);
    codeText.value = whyNotPaired.value = '';
    close();
  } catch (refused) {
    whyNotPaired.value = sentence(refused);
  }
}

const trySend = (): void => {
  if (codeText.value.trim() !== '' && nameText.value.trim() !== '') void send();
};

export function Pairing(): JSX.Element {
  const why =
    codeText.value.trim() === '' ? 'Type the code first.' : nameText.value.trim() === '' ? 'Type your name first.' : '';
  return (
    <Dialog title="Pair this browser" open={dialogOpen.value} onClose={close} class="pairing">
      <p>The program prints a pairing code when it starts. It works once.</p>
      <Field
        label="Code"
        value={codeText.value}
        placeholder="ABCD-EFGH"
        wide
        onInput={(text) => (codeText.value = text)}
        onEnter={trySend}
      />
      <Field
        label="Your name"
        value={nameText.value}
        wide
        onInput={(text) => (nameText.value = text)}
        onEnter={trySend}
      />
      <p class="why" role="alert">
        {whyNotPaired.value}
      </p>
      <div class="row end">
        <Button kind="main" why={why} onClick={trySend}>
          Pair
        </Button>
      </div>
    </Dialog>
  );
}

const ROLES = ['observe', 'operate', 'maintain'] as const;
const role = signal<(typeof ROLES)[number]>('operate');
const made = signal('');

async function invite(): Promise<void> {
  const reply = await commandFor('invite', { role: role.value });
  if (reply !== null) made.value = String(reply.code);
}

export function Inviting(): JSX.Element {
  return (
    <Dialog title="Invite a user" open={inviteOpen.value} onClose={() => (inviteOpen.value = false)} class="pairing">
      <p>A code lets one browser in, once, with the role that you choose.</p>
      <Choice
        label="Role"
        value={role.value}
        onChange={(to) => ((role.value = to), (made.value = ''))}
        options={ROLES.map((one) => ({ value: one, text: one }))}
      />
      <p class="code tabular" role="status">
        {made.value}
      </p>
      <div class="row end">
        <Button kind="main" why={whyNot('maintain')} onClick={() => void invite()}>
          Make a code
        </Button>
      </div>
    </Dialog>
  );
}
