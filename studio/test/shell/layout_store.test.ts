import { beforeEach, expect, test, vi } from 'vitest';
import type { Connection } from '../../src/connection';
import type { Json } from '../../src/json';
import { LayoutStore } from '../../src/shell/layout_store';

/** What a browser keeps, as an object whose own names are the keys. */
function storage(): Storage {
  const kept: Record<string, string> = {};
  const methods = {
    getItem: (name: string) => kept[name] ?? null,
    setItem: (name: string, text: string) => {
      kept[name] = text;
    },
    removeItem: (name: string) => delete kept[name],
  };
  return new Proxy(kept, {
    get: (_, name) => methods[name as keyof typeof methods],
  }) as unknown as Storage;
}

function store(call: (method: string) => Promise<Json>): LayoutStore {
  return new LayoutStore({ call } as unknown as Connection);
}

const refused = (): Promise<Json> => Promise.reject(new Error('no folder'));

beforeEach(() => {
  vi.stubGlobal('localStorage', storage());
  vi.stubGlobal('sessionStorage', storage());
});

test('without a folder of the server the browser keeps layouts', async () => {
  const layouts = store(refused);
  expect(await layouts.save('mine', { a: 1 })).toBe('browser');
  expect(await layouts.list()).toEqual(['mine']);
  expect(await layouts.load('mine')).toEqual({ a: 1 });
  await layouts.delete('mine');
  expect(await layouts.load('mine')).toBeNull();
});

test("the server's layouts go before the browser's", async () => {
  const answers: Record<string, Json> = {
    'layout.list': { names: ['b', 'mine'] },
    'layout.load': { value: { a: 2 } },
  };
  const layouts = store((method) => Promise.resolve(answers[method] ?? null));
  expect(await layouts.save('mine', { a: 1 })).toBe('server');
  expect(await layouts.load('mine')).toEqual({ a: 2 });
  expect(await layouts.list()).toEqual(['b', 'mine']);
});

test('what was open last is kept by the commands, in whatever order', () => {
  const layouts = store(refused);
  layouts.keepLast(['rviz', 'gzclient'], { a: 1 });
  expect(layouts.last(['gzclient', 'rviz', 'rviz'])).toEqual({ a: 1 });
  expect(layouts.last(['rviz'])).toBeNull();
  expect(layouts.tab()).toEqual({ commands: ['rviz', 'gzclient'], layout: { a: 1 } });
});

test('what cannot be read counts as nothing kept', () => {
  localStorage.setItem('gazelle.last.studio', '{');
  expect(store(refused).last([])).toBeNull();
});
