"""Boost's threads work where only its headers are: the compiled part is ours."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from tests.cpp.building.conftest import needs_compiler

from gazelle.cpp.building.runtime import ensure_runtime
from gazelle.cpp.building.toolchain import find_toolchain

pytestmark = [needs_compiler, pytest.mark.slow(40)]

PROGRAM = r"""
#include <boost/bind/bind.hpp>
#include <boost/thread.hpp>
#include <cstdio>

boost::mutex mutex;
boost::condition_variable changed;
bool is_open = false;
boost::once_flag flag = BOOST_ONCE_INIT;

struct Value {
  explicit Value(int n) : number(n) {}
  ~Value() { std::printf("value %d ends\n", number); }
  int number;
};
boost::thread_specific_ptr<Value> own;

void at_end() { std::puts("callback"); }
void once() { std::puts("once"); }

void wait_for_ever() {
  try {
    boost::unique_lock<boost::mutex> lock(mutex);
    while (!is_open) changed.wait(lock);
  } catch (const boost::thread_interrupted &) {
    std::puts("interrupted");
  }
}

void work(int number) {
  boost::call_once(flag, once);
  own.reset(new Value(number));
  boost::this_thread::at_thread_exit(at_end);
  boost::this_thread::sleep_for(boost::chrono::milliseconds(1));
}

void endless() {
  boost::this_thread::disable_interruption shut;
  boost::this_thread::interruption_point();
  std::puts("not interrupted");
}

int main() {
  boost::thread waiting(wait_for_ever);
  waiting.interrupt();
  waiting.join();
  std::printf("joinable %d\n", waiting.joinable());
  boost::thread first(boost::bind(work, 1));
  first.join();
  boost::thread second(work, 2);
  std::printf("joined in time %d\n", second.timed_join(boost::posix_time::seconds(20)));
  boost::thread stubborn(endless);
  stubborn.interrupt();
  stubborn.join();
  boost::thread closed(wait_for_ever);
  std::printf("joined at once %d\n", closed.try_join_for(boost::chrono::milliseconds(1)));
  {
    boost::lock_guard<boost::mutex> guard(mutex);
    is_open = true;
  }
  changed.notify_all();
  closed.join();
  boost::packaged_task<int> task([] { return 42; });
  boost::unique_future<int> answer = task.get_future();
  boost::thread(boost::move(task)).detach();
  std::printf("answer %d\n", answer.get());
  std::printf("cores %d\n", boost::thread::hardware_concurrency() > 0);
}
"""

SAID = """interrupted
joinable 0
once
callback
value 1 ends
callback
value 2 ends
joined in time 1
not interrupted
joined at once 0
answer 42
cores 1
"""


def test_threads_of_boost(tmp_path: Path) -> None:
    toolchain = find_toolchain()
    if not toolchain.has_boost:
        pytest.skip("needs headers of Boost")
    (library,) = ensure_runtime(["boost_thread"], 0).libraries.values()
    source, program = tmp_path / "threads.cpp", tmp_path / "threads"
    source.write_text(PROGRAM, encoding="utf-8")
    words = [*toolchain.command, *toolchain.flags, *toolchain.include_flags, "-O0", str(source)]
    link = [str(library), f"-Wl,-rpath,{library.parent}", "-o", str(program)]
    subprocess.run([*words, *link], check=True)
    done = subprocess.run([str(program)], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout) == (0, SAID)
