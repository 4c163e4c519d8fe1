// The form that a scene's JSON Schema gives: it shows the scene's values and says which of them are to change.

import {signal} from "@preact/signals";
import {createContext} from "preact";
import {useContext, useEffect, useId, useRef, useState} from "preact/hooks";
import {joinPointer, parse, valueAt, write} from "../json/text";
import {isObject, type Json, type JsonObject, type Problem, type Schema} from "../types";
import {IconButton} from "../ui/parts";

interface Form {
  root: Schema;
  scene: JsonObject;
  problems: Map<string, Problem[]>;
  /** What the chosen size changes; null without one. */
  size: {name: string; patch: Json} | null;
  /** `undefined` takes the value away, so that its default holds. */
  change: (pointer: string, value: Json | undefined) => void;
}
const FormContext = createContext<Form>(null!);

/** The place that a problem is to be shown at: groups on the way open, and who is it takes the focus and forgets it. A new object each
 * time. */
export const revealed = signal<{pointer: string} | null>(null);

function resolve(schema: Schema, root: Schema): Schema {
  let found = schema;
  for (let depth = 0; found.$ref && depth < 8; ++depth) {
    const target = root.$defs?.[found.$ref.replace("#/$defs/", "")];
    if (!target) break;
    const {$ref: _, ...own} = found;
    found = {...target, ...own};
  }
  const present = found.anyOf?.filter((choice) => choice.type !== "null");
  if (present?.length === 1) {
    const {anyOf: _, ...own} = found;
    return resolve({...present[0], ...own}, root);
  }
  return found;
}

/** The key by which variants differ, such as "type" or "model". */
function discriminator(variants: Schema[]): string | null {
  const keys = Object.keys(variants[0]?.properties ?? {});
  return keys.find((key) => variants.every((variant) => variant.properties?.[key]?.const !== undefined)) ?? null;
}

/** The variant that a value is of; without the key, the one that is the default. */
function variantOf(variants: Schema[], key: string, value: Json | undefined): Schema {
  const chosen = isObject(value) ? value[key] : undefined;
  return variants.find((variant) => variant.properties![key].const === chosen) ??
    variants.find((variant) => variant.properties![key].default !== undefined) ?? variants[0];
}

/** A value that can stand where the schema is, to begin with. */
function blank(schema: Schema, form: Form, key = ""): Json {
  const s = resolve(schema, form.root);
  if (s.const !== undefined) return s.const;
  if (s.default !== undefined) return s.default;
  if (s.oneOf) return blank(s.oneOf[0], form);
  if (s.enum) return s.enum[0];
  switch (s.type) {
    case "object": {
      const made: JsonObject = {};
      for (const name of s.required ?? []) made[name] = blank(s.properties?.[name] ?? {}, form, name);
      return made;
    }
    case "array": {
      const item = s.items ? blank(s.items, form) : 0;
      return Array.from({length: s.items && s.maxItems === 3 ? 3 : (s.minItems ?? 0)}, () => item);
    }
    case "number":
    case "integer":
      return Math.max(s.minimum ?? -Infinity, Math.min(s.maximum ?? Infinity, s.exclusiveMinimum !== undefined ? lengthScale(form) : 0));
    case "boolean":
      return false;
    default:
      return key === "material" ? firstMaterial(form) : key || "name";
  }
}

/** A few cells: a length that is neither lost in the scene nor fills it. */
const lengthScale = ({scene}: Form) => (typeof scene.spacing === "number" ? Number((5 * scene.spacing).toPrecision(3)) : 1);
const firstMaterial = ({scene}: Form) => {
  const name = valueAt(scene, "/materials/0/name");
  return typeof name === "string" ? name : "material";
};

const label = (key: string) => key.replace(/_deg$/, "").replaceAll("_", " ");
const unitOf = (schema: Schema) => (schema["x-unit"] && schema["x-unit"] !== "1" ? schema["x-unit"].replace(/\^2/g, "²").replace(/\^3/g, "³") : "");
const shown = (value: Json | undefined): string =>
  value === undefined || value === null ? "" : typeof value === "string" ? value : write(value);

/** Text that is taken over when the field is left or Enter is pressed; Escape takes it back. */
function TextInput(props: {
  id?: string; value: string; placeholder?: string; commit: (text: string) => void; name?: string; numeric?: boolean; invalid?: boolean;
  describedBy?: string;
}) {
  const {id, value, placeholder, commit, name, numeric, invalid, describedBy} = props;
  const [text, setText] = useState<string | null>(null);
  const take = () => {
    if (text !== null && text !== value) commit(text);
    setText(null);
  };
  return (
    <input id={id} type="text" class={numeric ? "numeric" : ""} inputMode={numeric ? "decimal" : "text"} autocomplete="off" spellcheck={false}
      aria-label={name} aria-invalid={invalid || undefined} aria-describedby={describedBy} value={text ?? value} placeholder={placeholder}
      onInput={(event) => setText(event.currentTarget.value)} onBlur={take} onKeyDown={(event) => {
        if (event.key === "Enter") {
          event.preventDefault();
          take();
        } else if (event.key === "Escape") {
          setText(null);
        }
      }} />
  );
}

/** A number where the text is one; the text itself elsewhere, for the server to say what is wrong with it. */
function numberFrom(text: string): Json | undefined {
  const trimmed = text.trim().replace("−", "-");
  if (trimmed === "") return undefined;
  const value = Number(trimmed);
  return Number.isFinite(value) ? value : trimmed;
}

interface FieldProps {
  name: string;
  title?: string;
  schema: Schema;
  pointer: string;
  value: Json | undefined;
  required?: boolean;
}

function Scalar({schema, pointer, value, id, invalid, describedBy}: FieldProps & {id: string; invalid: boolean; describedBy?: string}) {
  const {change} = useContext(FormContext);
  const common = {id, "aria-invalid": invalid || undefined, "aria-describedby": describedBy};
  if (schema.enum)
    return (
      <select {...common} value={value === undefined ? "" : String(value)}
        onChange={(event) => change(pointer, event.currentTarget.value === "" ? undefined : (schema.enum!.find((one) => String(one) === event.currentTarget.value) !))}>
        <option value="">{schema.default !== undefined ? `default: ${shown(schema.default)}` : "–"}</option>
        {value !== undefined && !schema.enum.includes(value) && <option value={String(value)}>{shown(value)}</option>}
        {schema.enum.map((one) => <option key={String(one)} value={String(one)}>{String(one)}</option>)}
      </select>
    );
  if (schema.type === "boolean")
    return (
      <select {...common} value={value === undefined ? "" : String(value)}
        onChange={(event) => change(pointer, event.currentTarget.value === "" ? undefined : event.currentTarget.value === "true")}>
        <option value="">{schema.default !== undefined ? `default: ${schema.default ? "yes" : "no"}` : "–"}</option>
        <option value="true">yes</option>
        <option value="false">no</option>
      </select>
    );
  const numeric = schema.type === "number" || schema.type === "integer";
  const byDefault = typeof schema.default === "number" && Math.abs(schema.default) >= 1e30 ? "no limit" : shown(schema.default);
  return (
    <TextInput id={id} numeric={numeric} value={shown(value)} placeholder={byDefault} invalid={invalid} describedBy={describedBy}
      commit={(text) => change(pointer, numeric ? numberFrom(text) : text === "" && schema.minLength !== 0 ? undefined : text)} />
  );
}

const axes = ["x", "y", "z"];

function VectorInput({name, schema, pointer, value, invalid}: FieldProps & {invalid: boolean}) {
  const {change, scene} = useContext(FormContext);
  const given = Array.isArray(value) ? value : [];
  const fallback = Array.isArray(schema.default) ? schema.default : [];
  const flat = scene.dimension === 2 && (schema.minItems ?? 0) <= 2;
  const count = Math.max(given.length, flat ? 2 : Math.min(schema.maxItems ?? 3, 4), schema.minItems ?? 0);
  const set = (i: number, item: Json | undefined) => {
    const next = Array.from({length: count}, (_, k) => given[k] ?? fallback[k] ?? 0);
    if (item === undefined && fallback[i] === undefined) return;
    next[i] = (item ?? fallback[i])!;
    change(pointer, next);
  };
  return (
    <span class="vector">
      {Array.from({length: count}, (_, i) => (
        <TextInput key={i} numeric name={`${name} ${axes[i] ?? i}`} value={shown(given[i])} placeholder={shown(fallback[i])} invalid={invalid}
          commit={(text) => set(i, numberFrom(text))} />
      ))}
    </span>
  );
}

/** What the form has no better input for, as JSON. */
function RawInput({name, pointer, value, schema, invalid}: FieldProps & {invalid: boolean}) {
  const {change} = useContext(FormContext);
  const [broken, setBroken] = useState("");
  return (
    <>
      <TextInput name={name} value={value === undefined ? "" : write(value)} placeholder={schema.default === undefined ? "JSON" : write(schema.default)} invalid={invalid || broken !== ""}
        commit={(text) => {
          try {
            change(pointer, text.trim() === "" ? undefined : parse(text).value);
            setBroken("");
          } catch (error) {
            setBroken(error instanceof Error ? error.message : "");
          }
        }} />
      {broken && <span class="field-problem">{broken}</span>}
    </>
  );
}

function Problems({pointer, id}: {pointer: string; id?: string}) {
  const problems = useContext(FormContext).problems.get(pointer);
  if (!problems) return null;
  return (
    <span class="field-problem" id={id}>
      {problems.map((problem) => `${problem.message ?? ""}${problem.allowed ? ` Allowed: ${problem.allowed}` : ""}`).join(" ")}
    </span>
  );
}

const isNumber = (schema: Schema | false | undefined, root: Schema) =>
  !!schema && ["number", "integer"].includes(resolve(schema, root).type ?? "");

/** One value: a row with an input, or a group of rows. */
function Field(props: FieldProps) {
  const {root, problems, size} = useContext(FormContext);
  const id = useId();
  const row = useRef<HTMLDivElement>(null);
  const schema = resolve(props.schema, root);
  const {pointer, value, required} = props;
  const wanted = revealed.value;
  useEffect(() => {
    if (wanted?.pointer !== pointer || !row.current) return;
    row.current.scrollIntoView({block: "center"});
    row.current.querySelector<HTMLElement>("input, select")?.focus({preventScroll: true});
    revealed.value = null;
  }, [wanted]);

  if (schema.const !== undefined) return null;
  if (schema.oneOf && discriminator(schema.oneOf)) return <Variant {...props} schema={schema} />;
  if (schema.type === "object" && schema.properties) return <Group {...props} schema={schema} />;
  if (schema.type === "array" && schema.items && ["object", undefined].includes(resolve(schema.items, root).type)) return <List {...props} schema={schema} />;

  const invalid = problems.has(pointer);
  const describedBy = [invalid && `${id}-problem`, schema.description && `${id}-help`].filter(Boolean).join(" ") || undefined;
  const vector = schema.type === "array" && isNumber(schema.items, root) && (schema.maxItems ?? 99) <= 4;
  const scalar = ["string", "number", "integer", "boolean"].includes(schema.type ?? "") || schema.enum !== undefined;
  const unit = unitOf(schema);
  const common = {...props, schema, invalid};
  const bySize = size ? valueAt(size.patch, pointer) : undefined;
  return (
    <div class={`field ${invalid ? "invalid" : ""} ${value === undefined ? "unset" : ""}`} ref={row}>
      <label for={scalar ? id : undefined} title={schema.description}>{props.title ?? label(props.name)}{required && <span class="required" aria-hidden="true"> *</span>}</label>
      <span class="input">
        {scalar ? <Scalar {...common} id={id} describedBy={describedBy} /> : vector ? <VectorInput {...common} /> : <RawInput {...common} />}
        {unit && <span class="unit">{unit}</span>}
      </span>
      {bySize !== undefined && <span class="field-size">{size!.name}: {shown(bySize)}</span>}
      {schema.description && <span class="field-help" id={`${id}-help`}>{schema.description}</span>}
      <Problems pointer={pointer} id={`${id}-problem`} />
    </div>
  );
}

/** Children are made when it is first opened: a scene has thousands of possible fields. */
function Fold(props: {
  name: string; words: string; description?: string; pointer: string; open?: boolean; absent?: boolean; children: () => preact.ComponentChildren; remove?: () => void;
}) {
  const {name, words, description, pointer, absent, children, remove} = props;
  const {problems} = useContext(FormContext);
  const [open, setOpen] = useState(props.open ?? false);
  const summary = useRef<HTMLElement>(null);
  const wanted = revealed.value;
  useEffect(() => {
    if (wanted?.pointer.startsWith(`${pointer}/`)) setOpen(true);
    if (wanted?.pointer !== pointer) return;
    setOpen(true);
    summary.current?.focus();
    revealed.value = null;
  }, [wanted]);
  let wrong = 0;
  for (const [at, list] of problems) if (at === pointer || at.startsWith(`${pointer}/`)) wrong += list.length;
  return (
    <details class={`fold ${absent ? "absent" : ""}`} open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary ref={summary} title={description}>
        <span class="fold-name">{name}</span> <span class="fold-words">{words}</span>
        {wrong > 0 && <span class="wrong">{wrong} {wrong === 1 ? "problem" : "problems"}</span>}
      </summary>
      {remove && <IconButton icon="remove" label={`Remove ${name}`} run={remove} />}
      {open && <div class="fold-body"><Problems pointer={pointer} />{children()}</div>}
    </details>
  );
}

function Fields({schema, pointer, value, skip}: {schema: Schema; pointer: string; value: Json | undefined; skip?: string}) {
  const object = isObject(value) ? value : {};
  const required = new Set(schema.required ?? []);
  const names = Object.keys(schema.properties ?? {}).filter((name) => name !== skip);
  return (
    <>
      {names.map((name) => (
        <Field key={name} name={name} schema={schema.properties![name]} pointer={joinPointer(pointer, name)}
          value={Object.hasOwn(object, name) ? object[name] : undefined} required={required.has(name)} />
      ))}
    </>
  );
}

function Group({name, title, schema, pointer, value, required}: FieldProps) {
  const {change} = useContext(FormContext);
  const words = value === undefined ? "default" : `${Object.keys(isObject(value) ? value : {}).length} set`;
  return (
    <Fold name={title ?? label(name)} words={words} description={schema.description} pointer={pointer} absent={value === undefined} open={required && name === "domain"}
      remove={value !== undefined && !required ? () => change(pointer, undefined) : undefined}>
      {() => <Fields schema={schema} pointer={pointer} value={value} />}
    </Fold>
  );
}

function Variant({name, title, schema, pointer, value, required}: FieldProps) {
  const form = useContext(FormContext);
  const id = useId();
  const key = discriminator(schema.oneOf!)!;
  const chosen = variantOf(schema.oneOf!, key, value);
  const choose = (kind: string) => {
    const variant = schema.oneOf!.find((one) => String(one.properties![key].const) === kind)!;
    const made = blank(variant, form) as JsonObject;
    made[key] = kind;
    // What both kinds have stays.
    for (const [member, old] of Object.entries(isObject(value) ? value : {}))
      if (member !== key && variant.properties && Object.hasOwn(variant.properties, member)) made[member] = old;
    form.change(pointer, made);
  };
  const kind = value === undefined ? "" : String(chosen.properties![key].const);
  return (
    <Fold name={title ?? label(name)} words={value === undefined ? "default" : kind} description={schema.description} pointer={pointer} absent={value === undefined}
      remove={value !== undefined && !required ? () => form.change(pointer, undefined) : undefined}>
      {() => (
        <>
          <div class="field">
            <label for={id}>{key}</label>
            <span class="input">
              <select id={id} value={kind} onChange={(event) => choose(event.currentTarget.value)}>
                {value === undefined && <option value="">default</option>}
                {schema.oneOf!.map((variant) => String(variant.properties![key].const)).map((one) => <option key={one} value={one}>{one}</option>)}
              </select>
            </span>
            <Problems pointer={joinPointer(pointer, key)} />
          </div>
          {value !== undefined && <Fields schema={chosen} pointer={pointer} value={value} skip={key} />}
        </>
      )}
    </Fold>
  );
}

function List({name, schema, pointer, value, required}: FieldProps) {
  const form = useContext(FormContext);
  const items = Array.isArray(value) ? value : [];
  const itemSchema = schema.items as Schema;
  const singular = label(name).replace(/ies$/, "y").replace(/([^s])s$/, "$1");
  const titleOf = (item: Json, i: number) => (isObject(item) && typeof item.name === "string" && item.name ? item.name : `${singular} ${i + 1}`);
  return (
    <Fold name={label(name)} words={items.length === 0 ? "none" : String(items.length)} description={schema.description} pointer={pointer} absent={items.length === 0}
      open={items.length > 0 && ["materials", "bodies"].includes(name)}>
      {() => (
        <>
          {items.map((item, i) => (
            <div class="item" key={i}>
              <Field name={name} title={titleOf(item, i)} schema={itemSchema} pointer={joinPointer(pointer, i)} value={item} required />
              {!(required && items.length <= (schema.minItems ?? 0)) && (
                <IconButton icon="remove" label={`Remove ${titleOf(item, i)}`} run={() => form.change(joinPointer(pointer, i), undefined)} />
              )}
            </div>
          ))}
          <button type="button" class="button small" onClick={() => {
            const made = blank(itemSchema, form);
            if (value === undefined) form.change(pointer, [made]);
            else form.change(joinPointer(pointer, items.length), made);
          }}>Add {singular}</button>
        </>
      )}
    </Fold>
  );
}

export function SceneForm({schema, size, ...form}: {schema: Schema; size: string} & Omit<Form, "root" | "size">) {
  // Sizes are patches of the whole scene: they are written in the JSON.
  const {sizes: _, ...properties} = schema.properties ?? {};
  const patch = size ? valueAt(form.scene, joinPointer("/sizes", size)) : undefined;
  return (
    <FormContext.Provider value={{...form, root: schema, size: patch === undefined ? null : {name: size, patch}}}>
      <div class="form">
        <Fields schema={{...schema, properties}} pointer="" value={form.scene} />
      </div>
    </FormContext.Provider>
  );
}
