// Dialog over the page, which stays usable: STOP is never covered. Esc closes it and also sends STOP.
import type { ComponentChildren, JSX } from 'preact';
import { useEffect, useId, useRef } from 'preact/hooks';
import { Icon } from './icons';

export function Dialog(props: {
  title: string;
  open: boolean;
  onClose: () => void;
  children: ComponentChildren;
  class?: string;
}): JSX.Element | null {
  const element = useRef<HTMLDialogElement>(null);
  const id = useId();
  useEffect(() => {
    const dialog = element.current;
    if (dialog === null) return;
    if (props.open && !dialog.open) dialog.show();
    else if (!props.open && dialog.open) dialog.close();
    if (props.open) dialog.querySelector<HTMLElement>('input, button')?.focus();
  }, [props.open]);
  if (!props.open) return null;
  return (
    <dialog ref={element} class={props.class} aria-labelledby={id} onClose={props.onClose}>
      <div class="head">
        <h2 id={id}>{props.title}</h2>
        <button type="button" class="button quiet" aria-label="Close" onClick={props.onClose}>
          <Icon name="close" />
        </button>
      </div>
      {props.children}
    </dialog>
  );
}
