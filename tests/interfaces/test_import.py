from __future__ import annotations

import subprocess
import sys


def test_import_leaves_heavy_modules_alone():
    code = (
        "import sys, gazelle.interfaces as i; "
        "late = {'yaml', 'numpy', 'hashlib', 'rich', 'difflib', "
        "'gazelle.interfaces.codec_writer', 'gazelle.diagnostics'} & set(sys.modules); "
        "print(sorted(late)); "
        "i.to_cdr(i.message_type('sensor_msgs/LaserScan')()); "
        "print(sorted({'yaml', 'gazelle.diagnostics'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split("\n")[:2] == ["[]", "[]"]
