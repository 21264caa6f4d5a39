// Requests to the server that this page came from. The token is in a header, never in an address.
const KEY = 'shorebreak-token';

let token = sessionStorage.getItem(KEY) || '';

export function hasToken() {
  return token !== '';
}

export function setToken(text) {
  token = text;
  if (text) sessionStorage.setItem(KEY, text);
  else sessionStorage.removeItem(KEY);
}

function headers() {
  return token ? { 'X-Token': token } : {};
}

// Throws an Error whose `status` is that of the answer, or 0 without one.
export async function ask(url, options = {}) {
  let answer;
  try {
    answer = await fetch(url, { cache: 'no-store', credentials: 'omit', ...options, headers: headers() });
  } catch (problem) {
    if (problem.name === 'AbortError') throw problem;
    throw Object.assign(new Error('the server does not answer'), { status: 0 });
  }
  if (answer.ok) return answer;
  let reason = `the server answers ${answer.status}`;
  try {
    reason = (await answer.json()).error || reason;
  } catch { /* the answer has no reason */ }
  throw Object.assign(new Error(reason), { status: answer.status });
}

export async function command(words) {
  return (await ask('/command', { method: 'POST', body: JSON.stringify(words) })).json();
}
