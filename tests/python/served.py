"""nbvopt serve as the tests start it."""

import os
import pathlib
import resource
import shutil
import subprocess
import tempfile
from typing import Optional

from hostile_http2 import resident_mib


def _limit_files(most: int) -> None:
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


class Server:
    """A server in a folder of its own, which holds its data folder too; `web` is its page."""

    def __init__(self, *arguments: str, listen: str = "", max_files: Optional[int] = None):
        """DATA in an argument stands for the data folder; `max_files` is the limit that it has."""
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="nbvopt-"))
        self.data = self.folder / "data"
        self.data.mkdir()
        command = [os.environ["NBVOPT_CLI"], "serve", "--create", "0.05"]
        command += ["--listen", listen or f"unix:{self.folder}/sock"]
        command += [argument.replace("DATA", str(self.data)) for argument in arguments]
        with (self.folder / "log").open("w") as log:
            self._process = subprocess.Popen(
                command,
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
                preexec_fn=None if max_files is None else lambda: _limit_files(max_files),
            )
        ready = self._process.stdout.readline()
        if not ready.startswith("listening on "):
            said = self.log()
            self.stop()
            raise RuntimeError(f"the server did not start: {said}")
        self.address = ready.removeprefix("listening on ").strip()
        if "--web" in arguments:
            self.web = self._process.stdout.readline().removeprefix("page at ").strip()

    def memory_mib(self) -> float:
        """What is resident."""
        return resident_mib(self._process.pid)

    def log(self) -> str:
        return (self.folder / "log").read_text()

    def end(self) -> None:
        """Ends it before the test does."""
        self._process.terminate()
        self._process.wait()

    def stop(self) -> None:
        self.end()
        self._process.stdout.close()
        shutil.rmtree(self.folder)
