"""Runs a job on a server and workers on this machine. The first worker is lost while it has a task.

usage: python local_cluster.py SUBMIT.PY FILE

FILE appears when the task runs that waits for the loss.
"""

import os
import runpy
import socket
import sys
import threading
import time

from hyperqueue.cluster import LocalCluster, WorkerConfig


def sockets():
    """The sockets of this process, which holds the server and its workers."""
    found = []
    for descriptor in map(int, os.listdir("/proc/self/fd")):
        try:
            found.append(socket.socket(fileno=os.dup(descriptor)))
        except OSError:
            pass  # Not a socket, or closed by now.
    return [s for s in found if s.family == socket.AF_INET]


def connections_to_server():
    """Ends of connections that lead to a port on which this process listens."""
    listens = lambda s: s.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN)
    found = sockets()
    ports = {s.getsockname()[1] for s in found if listens(s)}
    return [s for s in found if not listens(s) and s.getpeername()[1] in ports]


def lose(cluster, connection):
    """Cuts the worker off when its task runs, and starts two others."""
    while not os.path.exists(sys.argv[2]):
        time.sleep(0.05)
    connection.shutdown(socket.SHUT_RDWR)
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))


job = runpy.run_path(sys.argv[1])
with LocalCluster() as cluster:
    cluster.start_worker(WorkerConfig(cores=1))
    # No client is connected yet: the one connection is that of the worker.
    [connection] = connections_to_server()
    threading.Thread(target=lose, args=(cluster, connection), daemon=True).start()
    job["submit"](cluster.client())
