// The JSON editor. With CodeMirror a bundle of its own (build.mjs). It lives in a shadow root, for there its styles come as
// constructed sheets, which the server's Content-Security-Policy allows.

import {defaultKeymap, history, historyKeymap} from "@codemirror/commands";
import {json} from "@codemirror/lang-json";
import {bracketMatching, foldGutter, foldKeymap, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting} from "@codemirror/language";
import {type Diagnostic, lintGutter, setDiagnostics} from "@codemirror/lint";
import {highlightSelectionMatches, search, searchKeymap} from "@codemirror/search";
import {EditorState} from "@codemirror/state";
import {drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers} from "@codemirror/view";
import {tags} from "@lezer/highlight";
import type {Edit} from "./json/text";

export interface Mark {
  from: number;
  to: number;
  message: string;
  severity: "error" | "warning";
}

const highlighting = HighlightStyle.define([
  {tag: tags.propertyName, color: "var(--code-key)"},
  {tag: tags.string, color: "var(--code-text)"},
  {tag: tags.number, color: "var(--code-number)"},
  {tag: [tags.bool, tags.null], color: "var(--code-word)"},
  {tag: [tags.punctuation, tags.separator, tags.brace, tags.squareBracket], color: "var(--quiet)"},
]);

const looks = EditorView.theme({
  "&": {height: "100%", color: "var(--ink)", backgroundColor: "var(--sheet)", fontSize: "12.5px"},
  "&.cm-focused": {outline: "none"},
  ".cm-scroller": {fontFamily: "var(--mono)", lineHeight: "1.55"},
  ".cm-content": {caretColor: "var(--ink)", padding: "8px 0"},
  ".cm-gutters": {backgroundColor: "var(--sheet)", color: "var(--quiet)", border: "none"},
  ".cm-lineNumbers .cm-gutterElement": {paddingLeft: "12px"},
  ".cm-activeLine": {backgroundColor: "var(--hover)"},
  ".cm-cursor": {borderLeftColor: "var(--ink)"},
  ".cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground": {backgroundColor: "var(--selection)"},
  ".cm-matchingBracket": {backgroundColor: "var(--selection)", outline: "none"},
  ".cm-selectionMatch": {backgroundColor: "var(--hover)"},
  ".cm-foldGutter span": {color: "var(--quiet)"},
  ".cm-foldPlaceholder": {backgroundColor: "var(--hover)", border: "none", color: "var(--quiet)", padding: "0 6px"},
  ".cm-tooltip": {backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--line)", borderRadius: "6px", boxShadow: "var(--shadow)"},
  ".cm-diagnostic": {padding: "6px 10px", whiteSpace: "pre-wrap", fontFamily: "var(--font)", maxWidth: "36em"},
  ".cm-diagnostic-error": {borderLeft: "3px solid var(--bad)"},
  ".cm-panels": {backgroundColor: "var(--paper)", color: "var(--ink)", borderColor: "var(--line)"},
  ".cm-panel input, .cm-panel button": {fontFamily: "var(--font)", color: "var(--ink)", backgroundColor: "var(--sheet)", backgroundImage: "none", border: "1px solid var(--line)", borderRadius: "4px"},
});

export class Editor {
  private readonly view: EditorView;
  private quiet = false;

  /** `changed` is called with what the user has typed. */
  constructor(host: HTMLElement, text: string, label: string, changed: (text: string) => void) {
    const root = host.shadowRoot ?? host.attachShadow({mode: "open"});
    const place = document.createElement("div");
    place.style.height = "100%";
    root.replaceChildren(place);
    this.view = new EditorView({
      root,
      parent: place,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(), foldGutter(), lintGutter(), history(), drawSelection(), indentOnInput(), bracketMatching(), highlightActiveLine(),
          highlightSelectionMatches(), search({top: true}), json(), indentUnit.of("  "), syntaxHighlighting(highlighting), looks,
          // Tab moves the focus on, as everywhere on the page.
          keymap.of([...defaultKeymap, ...historyKeymap, ...foldKeymap, ...searchKeymap]),
          EditorView.contentAttributes.of({"aria-label": label, tabindex: "0"}),
          EditorView.updateListener.of((update) => {
            if (update.docChanged && !this.quiet) changed(update.state.doc.toString());
          }),
        ],
      }),
    });
  }

  /** In place of all text. Does not count as typed. */
  setText(text: string) {
    if (this.view.state.doc.toString() === text) return;
    this.quietly(() => this.view.dispatch({changes: {from: 0, to: this.view.state.doc.length, insert: text}}));
  }

  /** An edit of `text`; where something else stands by now, there is nothing to do here. */
  apply(edit: Edit, text: string) {
    if (this.view.state.doc.toString() !== text) return;
    this.quietly(() => this.view.dispatch({changes: edit}));
  }

  mark(marks: Mark[]) {
    const length = this.view.state.doc.length;
    const diagnostics: Diagnostic[] = marks.map((mark) => ({...mark, from: Math.min(mark.from, length), to: Math.min(mark.to, length)}));
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  /** Selects a place and shows it; takes the focus only when asked to. */
  reveal(from: number, to: number, focus: boolean) {
    const length = this.view.state.doc.length;
    const selection = {anchor: Math.min(from, length), head: Math.min(to, length)};
    this.view.dispatch({selection, effects: EditorView.scrollIntoView(selection.anchor, {y: "center"})});
    if (focus) this.view.focus();
  }

  destroy() {
    this.view.destroy();
  }

  private quietly(action: () => void) {
    this.quiet = true;
    action();
    this.quiet = false;
  }
}
