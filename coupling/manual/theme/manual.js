// diptych: the page that searches
// SPDX-License-Identifier: LGPL-2.1-or-later
const field = document.getElementById('words');
if (field) {
  const entries = JSON.parse(document.getElementById('find-data').textContent);
  const texts = entries.map((entry) => entry.join(' ').toLowerCase());
  const most = 100;
  const element = (tag, text, name) => Object.assign(document.createElement(tag), { textContent: text, className: name || '' });
  const row = ([name, kind, link, meaning]) => {
    const box = element('div', '', 'entry'), head = element('p', '', 'head'), to = element('a', '');
    to.href = link;
    to.append(element('code', name));
    head.append(to, element('span', kind, 'fact'));
    box.append(head, element('p', meaning, 'meaning'));
    return box;
  };
  const show = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = entries.filter((_, k) => words.every((word) => texts[k].includes(word)));
    document.getElementById('found-count').textContent = found.length + ' found' + (found.length > most ? '; the first ' + most + ':' : '');
    document.getElementById('found').replaceChildren(...found.slice(0, most).map(row));
  };
  field.addEventListener('input', show);
  field.value = decodeURIComponent(location.hash.slice(1));
  show();
}
