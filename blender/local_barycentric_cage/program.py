# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program flbc in the background."""
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

# In zips that contain the program.
OWN = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'bin',
                   'flbc.exe' if os.name == 'nt' else 'flbc')
DONE, NOT_CONVERGED = 0, 3  # exit status; after 3 the result is written


class Refusal(Exception):
    """Something that the user can change, in words for the user."""


def find(path):
    """Returns the program: `path` if it is set, else the add-on's own, else `flbc` of the search path.

    Raises Refusal if there is none.
    """
    if not path and os.path.exists(OWN):
        if not os.access(OWN, os.X_OK):  # Blender unzips files without permissions
            os.chmod(OWN, 0o755)
        return OWN
    found = shutil.which(os.path.expanduser(path) or 'flbc')
    if found:
        return found
    if path:
        raise Refusal(f'{path} is not a program. Set the path of flbc in the preferences')
    raise Refusal('The program flbc is missing. Install it, or set its path in the preferences')


class Command:
    """Arguments of the program, and the names of files that users know by other names."""

    def __init__(self, arguments, names=()):
        self.arguments = [str(argument) for argument in arguments]
        self.names = dict(names)


class _Process:
    # The program shows its progress only on a terminal, so it gets one. Windows has none: a file
    # takes its place.
    def __init__(self, command):
        self._names = command.names
        self._text = ''
        self._file = None
        if hasattr(os, 'openpty'):
            self._terminal, theirs = os.openpty()
            os.set_blocking(self._terminal, False)
        else:
            theirs, self._file = tempfile.mkstemp()
            self._terminal = os.open(self._file, os.O_RDONLY)
        try:
            self._process = subprocess.Popen(
                command.arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                stderr=theirs, start_new_session=True,
                # Threads that wait actively would slow down Blender, and be slowed down by it.
                env={**os.environ, 'OMP_WAIT_POLICY': 'passive'})
        except OSError as error:
            self._close()
            raise Refusal(f'{command.arguments[0]}: {error.strerror}') from error
        finally:
            os.close(theirs)

    def _read(self):
        try:
            while data := os.read(self._terminal, 65536):
                self._text += data.decode(errors='replace')
        except OSError:  # nothing new, or the program has ended
            pass

    def status(self):
        """The exit status, None while the program runs."""
        status = self._process.poll()
        self._read()
        return status

    def _lines(self):
        """What was written, without what was erased later."""
        return [line.split('\r')[-1].replace('\x1b[K', '')
                for line in self._text.replace('\r\n', '\n').split('\n')]

    def progress(self):
        return self._lines()[-1]

    def messages(self):
        text = '\n'.join(line for line in self._lines() if line.startswith('flbc'))
        for path, name in self._names.items():
            text = text.replace(str(path), name)
        # Advice about the command line does not help in Blender.
        text = re.sub(r'; [^;\n]*(--|flbc )[^;\n]*', '', text)
        return re.sub(r'^flbc[^:]*: ', '', text, flags=re.M)

    def stop(self):
        if self._process.poll() is None:
            if hasattr(os, 'killpg'):
                os.killpg(self._process.pid, signal.SIGTERM)
            else:
                self._process.terminate()
            self._process.wait()
        self._close()

    def _close(self):
        os.close(self._terminal)
        if self._file:
            os.unlink(self._file)


class Job:
    """Runs the commands that a generator yields, one after another.

    The generator gets back what the user should know about each result, or a Refusal if the command
    failed. It may yield None to be called again later. Call poll() until it returns True, or run().
    """

    def __init__(self, steps):
        self._steps = steps
        self._process = None
        self._start = time.monotonic()

    def poll(self):
        """Advances without waiting. Returns whether all is done.

        Raises what the generator raises. The job has then ended.
        """
        try:
            if self._process is None:
                command = next(self._steps)
            else:
                status = self._process.status()
                if status is None:
                    return False
                process, self._process = self._process, None
                process.stop()
                messages = process.messages()
                if status == DONE:
                    command = self._steps.send('')
                elif status == NOT_CONVERGED:
                    command = self._steps.send(messages + '. ')
                else:
                    command = self._steps.throw(
                        Refusal(messages or f'flbc ended with status {status}'))
        except StopIteration:
            return True
        if command:
            self._process = self._started(command)
        return False

    def _started(self, command):
        try:
            return _Process(command)
        except Refusal:
            self.cancel()
            raise

    def run(self):
        """Runs to the end."""
        while not self.poll():
            time.sleep(0.005)

    def cancel(self):
        """Stops the command that runs, and the generator."""
        if self._process:
            self._process.stop()
            self._process = None
        self._steps.close()

    def progress(self):
        """A line that says what is being done, and the part that is done, in [0, 1]."""
        line = self._process.progress() if self._process else ''
        percent = re.search(r'(\d+)%', line)
        stage = re.split(r'[\[,(]', line)[0].strip() or f'{time.monotonic() - self._start:.0f} s'
        return stage, int(percent[1]) / 100 if percent else 0.0
