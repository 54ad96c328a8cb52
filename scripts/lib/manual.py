#!/usr/bin/env python3
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts/doc does with the manual after Doxygen.

    manual.py finish HTML            completes the index of the search, and drops what names no header
    manual.py check HTML ROOT        dead links, what a page would fetch, paths of this machine, literal asterisks
    manual.py widths HTML CHROMIUM   pages that are wider than their pane, in a window of 1280 pixels

HTML is the folder that Doxygen wrote. Prints every offence, and fails if there is one.
"""

import html
import json
import os
import re
import subprocess
import sys
import tempfile
import unicodedata


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def write(path, text):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)


def pages(folder):
    return sorted(name for name in os.listdir(folder) if name.endswith('.html'))


def plain(fragment):
    """The text of a piece of HTML."""
    return ' '.join(html.unescape(re.sub(r'<[^>]*>', '', fragment)).split())


# ------------------------------------------------------------------- search ----
# Doxygen's search knows names of the reference only. Here it also learns the headings of the manual, the names and words
# with which rows of tables and items of lists begin (named parameters, statuses, words), and the options of the program.

def identifier(text):
    """As convertToId() of Doxygen's search.js."""
    return ''.join(c if re.match('[a-z0-9\u0080-\uffff]', c) else '_%02x' % ord(c) for c in text.lower())


def with_anchors(text):
    """The page with an anchor in every first cell of a table, and every item of a list, that begins with a name or a word."""
    seen = set()

    def insert(found):
        begin, tag, words = found.groups()
        anchor = 'name_' + re.sub(r'\W+', '_', plain(words))
        if anchor in seen:
            return found.group()
        seen.add(anchor)
        return '%s<a class="anchor" id="%s"></a><%s>%s</%s>' % (begin, anchor, tag, words, tag)
    return re.sub(r'(<tr[^>]*>\s*<td[^>]*>|<li>)<(code|b)>(.*?)</\2>', insert, text)


def anchored(folder):
    """(words, page, anchor, title of the page) of all headings, names and words with an anchor before them, and of options."""
    anchor = r'<a class="anchor" id="([^"]+)"></a>\s*'
    for page in pages(folder):
        path, text = os.path.join(folder, page), read(os.path.join(folder, page))
        title = plain(re.search(r'<title>(.*?)</title>', text, re.S).group(1)).split(': ', 1)[-1]
        if re.match(r'index|ConformalEquivalence|group__PkgConformalEquivalenceNamedParameters', page):
            text = with_anchors(text)
            write(path, text)
            for name, words in re.findall(anchor + r'<(?:code|b)>(.*?)</(?:code|b)>', text, re.S):
                for part in plain(words).split(', '):
                    yield part, page, name, title
        section = title
        for heading in re.finditer(r'<h([1-4])[^>]*>' + anchor + r'(.*?)</h\1>(.*?)(?=<h[1-4]\b|\Z)', text, re.S):
            level, name, words, body = heading.groups()
            yield plain(words), page, name, title if level == '1' else section
            section = '%s: %s' % (title, plain(words)) if level == '1' else section
            for option in sorted(set(re.findall(r'(?<=\s)--[a-z][a-z-]+', ' '.join(re.findall(r'<pre.*?</pre>', body, re.S))))):
                yield option, page, name, plain(words)


def entries_of(words, page, anchor, title):
    """Entries that begin with each word but the little ones, as the search compares beginnings."""
    little = {'a', 'an', 'and', 'are', 'as', 'at', 'be', 'by', 'can', 'for', 'from', 'in', 'is', 'it', 'its', 'of', 'on',
              'or', 'that', 'the', 'this', 'to', 'what', 'which', 'with'}
    begins = [begin.start() for begin in re.finditer(r'\w+', words) if begin.group().lower() not in little]
    for begin in begins + [0] * words.startswith('-'):
        key = words[begin:]
        without_accents = ''.join(c for c in unicodedata.normalize('NFD', key) if not unicodedata.combining(c))
        for k in sorted({key, without_accents}):
            yield identifier(k), [words, ['../%s#%s' % (page, anchor), 1, title]]


def first_letter(key):
    code = re.match(r'_([0-9a-f]{2})', key)
    return chr(int(code.group(1), 16)) if code else key[0]


def complete_search(folder):
    search = os.path.join(folder, 'search')
    entries, template = [], read(os.path.join(search, 'all_0.html'))
    for name in os.listdir(search):
        if re.fullmatch(r'all_[0-9a-f]+\.js', name):
            body = read(os.path.join(search, name))
            body = body[body.index('['):body.rindex(']') + 1]
            body = re.sub(r"\\'", "\u0001", body)       # the strings of Doxygen are in single quotes
            body = body.replace('\\"', '"').replace('"', '\\"').replace("'", '"').replace("\u0001", "'")
            entries += [(re.sub(r'_\d+$', '', e[0]), e[1]) for e in json.loads(body)]
    merged = {}
    for key, value in entries + [e for a in anchored(folder) for e in entries_of(*a)]:
        places = merged.setdefault((key, value[0]), [])
        places += [p for p in value[1:] if p not in places]

    letters = sorted({first_letter(key) for key, _ in merged})
    for number, letter in enumerate(letters):
        mine = sorted(item for item in merged.items() if first_letter(item[0][0]) == letter)
        data = [['%s_%d' % (key, i), [words] + places] for i, ((key, words), places) in enumerate(mine)]
        write(os.path.join(search, 'all_%x.js' % number),
              'var searchData=\n[\n  ' + ',\n  '.join(json.dumps(d, ensure_ascii=False) for d in data) + '\n];\n')
        write(os.path.join(search, 'all_%x.html' % number), template.replace('all_0.js', 'all_%x.js' % number))
    path = os.path.join(search, 'searchdata.js')
    write(path, re.sub(r'(\b0: )"(?:[^"\\]|\\.)*"', lambda m: m.group(1) + json.dumps(''.join(letters), ensure_ascii=False),
                       read(path), count=1))
    return len(merged)


def finish(folder):
    # Concepts are in no header, but in files of the manual.
    for page in pages(folder):
        path, text = os.path.join(folder, page), read(os.path.join(folder, page))
        without = re.sub(r'<p><code>#include &lt;[^\n]*Concepts/[^\n]*</code></p>\n?', '', text)
        if without != text:
            write(path, without)
    print('The search knows %d names and words.' % complete_search(folder))


# ------------------------------------------------------------------- checks ----

def check(folder, root):
    text_of = {page: read(os.path.join(folder, page)) for page in pages(folder)}
    anchors = {page: set(re.findall(r'\b(?:id|name)="([^"]*)"', text)) for page, text in text_of.items()}
    for page, text in text_of.items():
        for link in set(re.findall(r'\bhref="([^"]*)"', text)):
            target, _, anchor = html.unescape(link).partition('#')
            if re.match(r'[a-z]+:', target):
                continue
            target = target or page
            if not os.path.exists(os.path.join(folder, target)):
                yield '%s: no file %s' % (page, target)
            elif anchor and target in anchors and anchor not in anchors[target]:
                yield '%s: no anchor %s' % (page, link)
        for fetched in re.findall(r'<(?:script|img|object|iframe|embed)[^>]*(?:src|data)="(https?:[^"]*)"', text) \
                + re.findall(r'<link[^>]*href="(https?:[^"]*)"', text):
            yield '%s: would fetch %s' % (page, fetched)
        if root in text or root.lstrip('/') in text:
            yield '%s: names the folder %s' % (page, root)
        prose = re.sub(r'<(pre|code|title|svg)\b.*?</\1>|<div class="(fragment|memproto)">.*?</div><!-- \2 -->'
                       r'|<td class="mem(Item|TemplItem).*?</td>|<td class="memname">.*?</tr>|\\\(.*?\\\)|\\\[.*?\\\]',
                       '', text, flags=re.S)
        for words in re.findall(r'(?<![\w*])\*[A-Za-z][^*<\n]{0,60}\*(?!\w)', plain(prose)):
            yield '%s: literal asterisks in %s' % (page, words)


# ------------------------------------------------------------------- widths ----

WIDTHS = """<!DOCTYPE html>
<html><head><meta charset="utf-8"></head><body style="margin:0"><pre id="result">unfinished</pre><script>
const formulas = new Set(FORMULAS), names = NAMES, lines = [];
let next = 0, running = 0;
const wide = doc => {
  const pane = doc.getElementById('doc-content') || doc.documentElement;
  if(pane.scrollWidth <= pane.clientWidth + 1)
    return null;
  const right = pane.getBoundingClientRect().left + pane.clientWidth + 1;
  const scrolled = e => e != pane && (doc.defaultView.getComputedStyle(e).overflowX != 'visible' || scrolled(e.parentElement));
  const out = [...pane.querySelectorAll('*')].filter(e => e.getBoundingClientRect().right > right && !scrolled(e.parentElement));
  const leaves = out.filter(e => ![...e.children].some(c => out.includes(c)));
  const e = leaves.sort((a, b) => b.getBoundingClientRect().right - a.getBoundingClientRect().right)[0] || pane;
  return `${pane.scrollWidth} pixels in ${pane.clientWidth}, for example <${e.tagName} ${e.className}> ${(e.textContent.trim() || e.parentNode.textContent.trim()).slice(0, 60)}`;
};
const begin = () => {
  if(next == names.length) {
    if(running == 0)
      document.getElementById('result').textContent = 'finished\\n' + lines.join('\\n');
    return;
  }
  const name = names[next++], frame = document.createElement('iframe');
  ++running;
  frame.style.cssText = 'width:1280px;height:900px;border:0';
  const done = () => {
    const what = wide(frame.contentDocument);
    if(what)
      lines.push(name + ': ' + what);
    frame.remove();
    --running;
    begin();
  };
  frame.onload = () => {
    const w = frame.contentWindow;
    if(formulas.has(name) && w.MathJax && w.MathJax.Hub)
      w.MathJax.Hub.Queue(done);
    else
      setTimeout(done, 20);
  };
  frame.src = name;
  document.body.appendChild(frame);
};
for(let i = 0; i < 4; ++i)
  begin();
</script></body></html>
"""


def widths(folder, chromium):
    """Loads the pages one after the other in frames of one page, and asks how wide they are."""
    names = [page for page in pages(folder)
             if not re.search(r'^(dir_|functions|namespacemembers|globals)|_8h\.html$|-members\.html$|-example\.html$', page)]
    formulas = [page for page in names if re.search(r'\\[(\[]', read(os.path.join(folder, page)))]
    path = os.path.join(os.path.abspath(folder), 'widths_of_pages.html')
    write(path, WIDTHS.replace('NAMES', json.dumps(names)).replace('FORMULAS', json.dumps(formulas)))
    try:
        with tempfile.TemporaryDirectory() as profile:
            dom = subprocess.run([chromium, '--headless', '--no-sandbox', '--disable-gpu', '--allow-file-access-from-files',
                                  '--user-data-dir=' + profile, '--window-size=1280,900', '--virtual-time-budget=600000',
                                  '--dump-dom', 'file://' + path],
                                 stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=300).stdout.decode()
    except subprocess.TimeoutExpired:
        print('SKIPPED: the pages could not be measured within five minutes')
        return
    finally:
        os.remove(path)
    result = re.search(r'<pre id="result">(.*?)</pre>', dom, re.S)
    lines = html.unescape(result.group(1)).split('\n') if result else []
    if not lines or lines[0] != 'finished':
        yield 'the widths of pages could not be measured'
        return
    yield from (line for line in lines[1:] if line)
    print('%d pages were measured.' % len(names))


def main(arguments):
    if arguments[:1] == ['finish'] and len(arguments) == 2:
        finish(arguments[1])
        return 0
    if arguments[:1] == ['check'] and len(arguments) == 3:
        offences = list(check(arguments[1], arguments[2]))
    elif arguments[:1] == ['widths'] and len(arguments) == 3:
        offences = list(widths(arguments[1], arguments[2]))
    else:
        sys.exit(__doc__)
    for offence in offences:
        print(offence)
    return 1 if offences else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
