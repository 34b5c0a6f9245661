// The dialog that asks for a pairing code.
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { sentence } from '../link/orders';
import { dialogOpen, pair } from '../link/pairing';
import { Dialog } from '../parts/dialog';
import { Button, Field } from '../parts/ui';

const NAME_KEY = 'motionrack.name';

export function Pairing(): JSX.Element {
  const code = useSignal('');
  const name = useSignal(localStorage.getItem(NAME_KEY) ?? '');
  const why = useSignal('');
  const send = async (): Promise<void> => {
    localStorage.setItem(NAME_KEY, name.value.trim());
    try {
      await pair(code.value, name.value);
      code.value = '';
      why.value = '';
      dialogOpen.value = false;
    } catch (refused) {
      why.value = sentence(refused);
    }
  };
  return (
    <Dialog title="Pair this browser" open={dialogOpen.value} onClose={() => (dialogOpen.value = false)} class="pairing">
      <p>The program printed a pairing code when it started. It works once.</p>
      <Field label="Code" value={code.value} placeholder="ABCD-EFGH" wide onInput={(text) => (code.value = text)} onEnter={() => void send()} />
      <Field label="Your name" value={name.value} wide onInput={(text) => (name.value = text)} onEnter={() => void send()} />
      <p class="why" role="alert">{why.value}</p>
      <div class="row end">
        <Button kind="main" why={code.value.trim() === '' ? 'Type the code first.' : name.value.trim() === '' ? 'Type your name first.' : ''} onClick={() => void send()}>Pair</Button>
      </div>
    </Dialog>
  );
}
