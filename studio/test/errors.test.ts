import { expect, test } from 'vitest';
import { asCallError, CallError, inOneLine } from '../src/errors';

test('an error of the server is one line: message, hint, what there is', () => {
  const error = CallError.from({
    message: 'No topic /scam',
    hint: 'did you mean /scan?',
    known: ['/scan', '/tf'],
  });
  expect(inOneLine(error)).toBe('No topic /scam; did you mean /scan?; there is /scan, /tf');
});

test('at most eight of the names that exist are said', () => {
  const known = Array.from({ length: 12 }, (_, index) => `n${index}`);
  expect(inOneLine(new CallError('No node', '', known))).toBe(
    'No node; there is n0, n1, n2, n3, n4, n5, n6, n7',
  );
});

test('anything thrown becomes an error with a message', () => {
  expect(CallError.from(null).message).toBe('The server gave no reason.');
  expect(asCallError(new TypeError('wrong')).message).toBe('wrong');
  expect(asCallError('text').message).toBe('text');
});
