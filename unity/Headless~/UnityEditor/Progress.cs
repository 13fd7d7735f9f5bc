using System;
using System.Collections.Generic;

namespace UnityEditor
{
    public static class Progress
    {
        static readonly Dictionary<int, Func<bool>> Cancels = new Dictionary<int, Func<bool>>();

        public static int Start(string name, string description = null, Options options = Options.None, int parentId = -1)
        {
            Headless.Project.ProgressItems.Add((description, Status.Running));
            return Headless.Project.ProgressItems.Count - 1;
        }

        public static void Report(int id, float progress) { }
        public static void Finish(int id, Status status = Status.Succeeded) =>
            Headless.Project.ProgressItems[id] = (Headless.Project.ProgressItems[id].Description, status);

        public static void RegisterCancelCallback(int id, Func<bool> callback) => Cancels[id] = callback;
        public static bool Cancel(int id) => Cancels[id]();

        public enum Status
        {
            Running,
            Succeeded,
            Failed,
            Canceled,
            Paused,
        }

        [Flags]
        public enum Options
        {
            None = 0,
            Sticky = 1,
            Indefinite = 2,
            Synchronous = 4,
            Managed = 8,
            Unmanaged = 16,
        }
    }
}
