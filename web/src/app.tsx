// The page: what the address names is shown below the bar.

import {render} from "preact";
import {useEffect, useState} from "preact/hooks";
import {ApiError, getHealth} from "./api";
import {keyGroups, useKeys} from "./keys";
import {announcement, dismiss, notices, online, trouble, usePolling} from "./live";
import {go, href, route} from "./router";
import {setTheme, type Theme, theme} from "./theme";
import {Icon} from "./ui/icon";
import {Dialog, IconButton} from "./ui/parts";
import {Compare} from "./views/compare";
import {takeFile} from "./views/gallery";
import {JobPage} from "./views/job";
import {NewJob} from "./views/new";
import {Queue} from "./views/queue";

function Keys({close}: {close: () => void}) {
  const [version, setVersion] = useState("");
  useEffect(() => {
    const stop = new AbortController();
    getHealth(stop.signal).then((health) => setVersion(health.version), () => {});
    return () => stop.abort();
  }, []);
  return (
    <Dialog title="Keys" close={close} wide>
      <div class="key-groups">
        {keyGroups.value.map((group) => (
          <section key={group.title}>
            <h3>{group.title}</h3>
            <dl>
              {group.bindings.map((binding) => (
                <div key={binding.words}><dt>{(binding.shown ?? binding.keys.join(" ")).split(" ").map((key) => <kbd key={key}>{key}</kbd>)}</dt><dd>{binding.words}</dd></div>
              ))}
            </dl>
          </section>
        ))}
      </div>
      <p class="about quiet">Lather {version} · <a href="licenses.txt" target="_blank" rel="noopener">Licences of what the page is made of</a></p>
      <p class="dialog-buttons"><button type="button" class="button" autofocus onClick={close}>Close</button></p>
    </Dialog>
  );
}

const nextTheme: Record<Theme, Theme> = {auto: "light", light: "dark", dark: "auto"};

function Bar({showKeys}: {showKeys: () => void}) {
  const {view} = route.value;
  // Views that ask for nothing by themselves notice, too, when the server is back.
  usePolling(async (signal) => {
    await getHealth(signal).catch((error) => {
      if (!(error instanceof ApiError)) throw error;
    });
  }, null, online.value);
  const tab = (name: string, words: string, target = href(name)) => (
    <a href={target} aria-current={view === name ? "page" : undefined}>{words}</a>
  );
  return (
    <header class="bar-top">
      <a class="skip" href="#main" onClick={(event) => {
        event.preventDefault();
        document.getElementById("main")?.focus();
      }}>To the content</a>
      <a class="brand" href={href("jobs")} aria-label="Lather, queue"><img src="icon.svg" alt="" width={20} height={20} /><span>Lather</span></a>
      <nav aria-label="Page">
        {tab("jobs", "Queue")}
        {tab("compare", "Compare")}
      </nav>
      <span class="spacer" />
      <span class="connection" role="status">{trouble.value && <><span class="pulse" aria-hidden="true" />{trouble.value}</>}</span>
      <IconButton icon={theme.value} label={`Colours: ${theme.value === "auto" ? "as the system" : theme.value}`} run={() => setTheme(nextTheme[theme.value])} />
      <IconButton icon="keyboard" label="Keys (?)" run={showKeys} />
      <a class="button primary small" href={href("new")}><Icon name="plus" /> New job</a>
    </header>
  );
}

function Notices() {
  return (
    <div class="notices">
      {notices.value.map((notice) => (
        <div key={notice.id} class={`notice ${notice.bad ? "bad" : ""}`} role={notice.bad ? "alert" : "status"}>
          <span>{notice.text}</span>
          <IconButton icon="cancel" label="Dismiss" run={() => dismiss(notice.id)} />
        </div>
      ))}
    </div>
  );
}

/** A file that is dropped anywhere starts a new job. */
function useDrop(): boolean {
  const [over, setOver] = useState(false);
  useEffect(() => {
    let depth = 0;
    const files = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    const enter = (event: DragEvent) => {
      if (!files(event)) return;
      ++depth;
      setOver(true);
    };
    const leave = () => {
      depth = Math.max(0, depth - 1);
      if (depth === 0) setOver(false);
    };
    const allow = (event: DragEvent) => {
      if (files(event)) event.preventDefault();
    };
    const drop = (event: DragEvent) => {
      if (!files(event)) return;
      event.preventDefault();
      depth = 0;
      setOver(false);
      void takeFile(event.dataTransfer!.files[0]);
    };
    const listeners: [string, (event: DragEvent) => void][] = [["dragenter", enter], ["dragleave", leave], ["dragover", allow], ["drop", drop]];
    for (const [name, listener] of listeners) window.addEventListener(name, listener as EventListener);
    return () => {
      for (const [name, listener] of listeners) window.removeEventListener(name, listener as EventListener);
    };
  }, []);
  return over;
}

function View() {
  const {view, id} = route.value;
  if (view === "job" && id) return <JobPage key={id} id={id} />;
  if (view === "new") return <NewJob />;
  if (view === "compare") return <Compare />;
  return <Queue />;
}

function App() {
  const [keys, setKeys] = useState(false);
  const over = useDrop();
  useKeys("Everywhere", [
    {keys: ["?"], words: "List the keys", run: () => setKeys(true)},
    {keys: ["n"], words: "New job", run: () => go(href("new"))},
    {keys: ["q"], words: "Queue", run: () => go(href("jobs"))},
  ]);
  const {view, id} = route.value;
  // A new view begins at its top, for readers of the screen, too.
  useEffect(() => {
    window.scrollTo(0, 0);
    const active = document.activeElement;
    if (active === document.body || !active?.isConnected) document.getElementById("main")?.focus({preventScroll: true});
  }, [view, id]);
  return (
    <>
      <Bar showKeys={() => setKeys(true)} />
      <View />
      <Notices />
      <div class="visually-hidden" role="status" aria-live="polite">{announcement.value}</div>
      {over && <div class="drop" aria-hidden="true"><span>Drop a scene, or a PNG that Lather drew</span></div>}
      {keys && <Keys close={() => setKeys(false)} />}
    </>
  );
}

render(<App />, document.getElementById("app")!);
