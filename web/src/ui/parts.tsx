// Small parts that several views are made of.

import type {ComponentChildren} from "preact";
import {useEffect, useRef, useState} from "preact/hooks";
import type {Job} from "../types";
import {fraction, stateWords} from "../jobs";
import {Icon} from "./icon";

export function State({job}: {job: Pick<Job, "state">}) {
  return <span class={`state ${job.state}`}>{stateWords[job.state] ?? job.state}</span>;
}

export function Bar({job}: {job: Job}) {
  return (
    <progress class={`bar ${job.state}`} max={1} value={fraction(job)} aria-label={`Progress of ${job.name || job.id}`} />
  );
}

export function IconButton(props: {icon: string; label: string; run: () => void; disabled?: boolean; pressed?: boolean; id?: string}) {
  const {icon, label, run, disabled, pressed, id} = props;
  return (
    <button type="button" id={id} class="icon-button" aria-label={label} title={label} disabled={disabled} aria-pressed={pressed} onClick={run}>
      <Icon name={icon} />
    </button>
  );
}

export function Facts({entries}: {entries: [string, ComponentChildren][]}) {
  return (
    <dl class="facts">
      {entries.filter(([, text]) => text !== "" && text !== null && text !== undefined).map(([name, text]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{text}</dd>
        </div>
      ))}
    </dl>
  );
}

/** A modal dialog while it is shown; Escape and the backdrop close it, and focus goes back to where it was. */
export function Dialog({title, close, children, wide}: {title: string; close: () => void; children: ComponentChildren; wide?: boolean}) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    element.current!.showModal();
    return () => {
      if (before instanceof HTMLElement && before.isConnected) before.focus();
    };
  }, []);
  return (
    <dialog ref={element} class={wide ? "wide" : ""} aria-labelledby="dialog-title" onClose={close}
      onClick={(event) => event.target === element.current && close()}>
      <div class="dialog-body">
        <h2 id="dialog-title">{title}</h2>
        {children}
      </div>
    </dialog>
  );
}

export function Confirm(props: {title: string; words: string; action: string; run: () => void; close: () => void}) {
  return (
    <Dialog title={props.title} close={props.close}>
      <p>{props.words}</p>
      <p class="dialog-buttons">
        <button type="button" class="button" autofocus onClick={props.close}>Keep</button>
        <button type="button" class="button danger" onClick={() => { props.close(); props.run(); }}>{props.action}</button>
      </p>
    </Dialog>
  );
}

/** Asks for one number. */
export function AskNumber(props: {
  title: string; words: string; label: string; unit?: string; value: number; least: number; most?: number; action: string;
  run: (value: number) => void; close: () => void;
}) {
  const [text, setText] = useState(String(props.value));
  const value = Number(text);
  const good = text.trim() !== "" && value >= props.least && value <= (props.most ?? Infinity);
  return (
    <Dialog title={props.title} close={props.close}>
      <form onSubmit={(event) => {
        event.preventDefault();
        if (!good) return;
        props.close();
        props.run(value);
      }}>
        <p class="quiet">{props.words}</p>
        <label class="ask">{props.label}
          <input type="text" inputMode="decimal" autofocus value={text} aria-invalid={!good || undefined} onInput={(event) => setText(event.currentTarget.value)} />
          {props.unit}
        </label>
        <p class="dialog-buttons">
          <button type="button" class="button" onClick={props.close}>Keep</button>
          <button type="submit" class="button primary" disabled={!good}>{props.action}</button>
        </p>
      </form>
    </Dialog>
  );
}

/** Tabs by the WAI-ARIA pattern: arrows move, Home and End jump. */
export function Tabs(props: {label: string; tabs: [string, string][]; chosen: string; choose: (id: string) => void; children: ComponentChildren}) {
  const {label, tabs, chosen, choose, children} = props;
  const list = useRef<HTMLDivElement>(null);
  const move = (event: KeyboardEvent) => {
    const index = tabs.findIndex(([id]) => id === chosen);
    const to = {ArrowRight: index + 1, ArrowLeft: index - 1, Home: 0, End: tabs.length - 1}[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const at = (to + tabs.length) % tabs.length;
    choose(tabs[at][0]);
    (list.current!.children[at] as HTMLElement).focus();
  };
  return (
    <section class="tabbed">
      <div class="tabs" role="tablist" aria-label={label} ref={list} onKeyDown={move}>
        {tabs.map(([id, words]) => (
          <button key={id} type="button" role="tab" id={`tab-${id}`} aria-selected={id === chosen} aria-controls="tab-panel"
            tabIndex={id === chosen ? 0 : -1} onClick={() => choose(id)}>{words}</button>
        ))}
      </div>
      <div id="tab-panel" role="tabpanel" aria-labelledby={`tab-${chosen}`} tabIndex={0}>{children}</div>
    </section>
  );
}

/** What is true of a media query now. */
export function useMedia(query: string): boolean {
  const [matches, set] = useState(() => matchMedia(query).matches);
  useEffect(() => {
    const media = matchMedia(query);
    const changed = () => set(media.matches);
    media.addEventListener("change", changed);
    return () => media.removeEventListener("change", changed);
  }, [query]);
  return matches;
}
