// A text with line numbers, and a tool's messages at their lines. Only the visible lines are in the document.

import {autocompletion, completeFromList} from "@codemirror/autocomplete";
import {defaultKeymap, history, historyKeymap, isolateHistory} from "@codemirror/commands";
import {HighlightStyle, StreamLanguage, syntaxHighlighting} from "@codemirror/language";
import {lintGutter, setDiagnostics} from "@codemirror/lint";
import {EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers} from "@codemirror/view";
import {tags} from "@lezer/highlight";

import {COMPLETIONS} from "./language.js";

const scenes = StreamLanguage.define({
  token(stream) {
    if (stream.match(/#.*/)) return "comment";
    if (stream.match(/[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?/)) return "number";
    if (stream.match(/[A-Za-z]\w*/)) return "keyword";
    stream.next();
    return null;
  },
});
const colors = HighlightStyle.define([{tag: tags.comment, color: "var(--soft)"}, {tag: tags.keyword, color: "var(--accent)"}, {tag: tags.number, color: "var(--shown)"}]);
const theme = EditorView.theme({
  "&": {height: "100%", color: "var(--ink)", backgroundColor: "var(--card)"},
  ".cm-scroller": {font: '12px/17px "DejaVu Sans Mono", ui-monospace, monospace'},
  ".cm-gutters": {backgroundColor: "var(--card)", color: "var(--soft)", border: "0"},
  ".cm-activeLine, .cm-activeLineGutter": {backgroundColor: "var(--hover)"},
  ".cm-cursor": {borderLeftColor: "var(--ink)"},
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": {backgroundColor: "var(--chosen)"},
  ".cm-tooltip": {backgroundColor: "var(--card)", color: "var(--ink)", border: "1px solid var(--edge)"},
});

export class Editor {
  // Calls `changed` after each edit of the reader's.
  constructor(box, name, changed) {
    this.isOwn = false;
    const language = name === "scene.txt" ? [scenes, syntaxHighlighting(colors), autocompletion({override: [completeFromList(COMPLETIONS)]})] : [scenes, syntaxHighlighting(colors)];
    const extensions = [
      lineNumbers(), history(), drawSelection(), highlightActiveLine(), lintGutter(), ...language, theme, keymap.of([...defaultKeymap, ...historyKeymap]),
      EditorView.contentAttributes.of({"aria-label": name, spellcheck: "false", tabindex: "0"}),
      EditorView.updateListener.of(update => { if (update.docChanged && !this.isOwn) changed(); }),
    ];
    this.view = new EditorView({extensions, parent: box});
  }

  // One string for each version of the text, since a long one is asked for several times.
  get text() {
    const {doc} = this.view.state;
    if (doc !== this.doc) Object.assign(this, {doc, whole: doc.toJSON().join("\n")});
    return this.whole;
  }

  // The reader can undo the change.
  set text(text) {
    if (text === this.text) return;
    this.isOwn = true;
    this.view.dispatch({changes: {from: 0, to: this.view.state.doc.length, insert: text}, selection: {anchor: 0}, scrollIntoView: true, annotations: isolateHistory.of("full")});
    this.isOwn = false;
  }

  // Marks lines: [{line, column, isError, text}], counted from 1; places after the end are at the end.
  mark(messages) {
    const {doc} = this.view.state;
    const marks = messages.map(({line, column, isError, text}) => {
      const at = doc.line(Math.max(1, Math.min(line, doc.lines))), from = Math.min(at.to, at.from + Math.max(0, column - 1));
      return {from, to: Math.max(from, at.to), severity: isError ? "error" : "info", message: text};
    });
    this.view.dispatch(setDiagnostics(this.view.state, marks.sort((a, b) => a.from - b.from)));
  }

  goTo(line) {
    const {doc} = this.view.state, at = doc.line(Math.max(1, Math.min(line, doc.lines)));
    this.view.dispatch({selection: {anchor: at.from}, scrollIntoView: true});
    this.view.focus();
  }
}
