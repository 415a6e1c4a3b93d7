type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | null>;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes))
    if (value !== null && value !== false) element.setAttribute(name, value === true ? '' : String(value));
  for (const child of children) if (child !== null) element.append(child);
}

/** An HTML element. Strings become text, never markup; null and false leave an attribute out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

/** An SVG element. */
export function s<K extends keyof SVGElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  fill(element, attributes, children);
  return element;
}

/** A button that does not send a form. */
export function button(attributes: Attributes, act: () => void, ...children: Child[]): HTMLButtonElement {
  const element = h('button', {type: 'button', ...attributes}, ...children);
  element.addEventListener('click', act);
  return element;
}

/** One choice of several as radio buttons, which arrow keys move between. */
export function choice(
  legend: string, options: [value: string, text: string][], value: string, act: (value: string) => void,
): HTMLFieldSetElement {
  const name = legend.toLowerCase().replace(/\W+/g, '-');
  const inputs = options.map(([option, text]) => {
    const input = h('input', {type: 'radio', name, value: option, checked: option === value});
    input.addEventListener('change', () => { act(option); });
    return h('label', {}, input, h('span', {}, text));
  });
  return h('fieldset', {class: 'choice'}, h('legend', {}, legend), ...inputs);
}

/** A line to copy: the text and a button that says when it has been copied. */
export function copyLine(text: string, what: string): HTMLElement {
  const copy = button({class: 'copy', 'aria-label': `Copy ${what}`}, () => {
    void copyText(text, code).then(done => {
      copy.textContent = done ? 'Copied' : 'Selected';
      setTimeout(() => { copy.textContent = 'Copy'; }, 2000);
    });
  }, 'Copy');
  const code = h('code', {tabindex: 0}, text);
  return h('div', {class: 'command'}, code, copy);
}

/** Where the clipboard is closed to the page the text is selected instead. */
async function copyText(text: string, element: HTMLElement): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    getSelection()?.selectAllChildren(element);
    return false;
  }
}

/** A link, if its address is one that a page may safely lead to; else its text. */
export function link(address: string | null, text: string): Child {
  if (address === null) return text;
  let protocol: string;
  try {
    protocol = new URL(address, document.baseURI).protocol;
  } catch {
    return text;
  }
  return ['http:', 'https:', 'file:'].includes(protocol) ? h('a', {href: address}, text) : text;
}
